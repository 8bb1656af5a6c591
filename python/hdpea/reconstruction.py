# SPDX-License-Identifier: GPL-3.0-or-later
"""All stages, one after the other: a cloud enters, a mesh leaves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from numpy.typing import ArrayLike, NDArray

from hdpea.embedding import Embedder, embed_surface
from hdpea.embedding.device import device_choices
from hdpea.embedding.tangents import tangent_bases
from hdpea.errors import core_errors_translated
from hdpea.frontend.cleaning import surface_cloud
from hdpea.geometry.texture import Texture
from hdpea.mesh.assembly import assemble_mesh
from hdpea.mesh.attributes import vertex_attributes
from hdpea.mesh.budget import particles_wanted
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.levels import coarser_levels
from hdpea.mesh.noise import within_noise
from hdpea.mesh.sides import FacedMesh, facing_out
from hdpea.mesh.texture import require_colors, texture_of
from hdpea.options import Classes, EmbeddingOptions, Length, MeshingOptions, Options
from hdpea.options.settings import changed
from hdpea.reading.attributes import split_colors
from hdpea.reading.cloud import PointCloud, cleaned_cloud
from hdpea.reading.objects import PointsLike
from hdpea.report.achieved_error import AchievedError, achieved_error
from hdpea.report.measurement import Comparison, coarseness, compare, level_facts, mesh_facts, missed_targets
from hdpea.report.report import Journal, MeshFacts, Report
from hdpea.result import Level, Reconstruction
from hdpea.runtime.clock import StageClock
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.runtime.pytorch import check_pytorch, load_in_background, torch_device
from hdpea.runtime.threads import limited_threads
from hdpea.surface.preparation import Preparation, prepare_surface
from hdpea.surface.surface import Surface

PHASES = (
    "cleaning",
    "normals",
    "denoising",
    "embedding",
    "particles",
    "meshing",
    "refinement",
    "simplification",
    "remeshing",
    "repair",
    "measuring",
)
"""The phases that ``progress`` hears of, in order; of denoising only if there is noise, or it is asked for, and of
simplification, remeshing, and another refinement after them, only if fewer vertices are wanted than particles are
spread."""


def reconstruct(
    points: PointsLike,
    normals: ArrayLike | None = None,
    options: Options | None = None,
    progress: ProgressCallback | None = None,
    sensors: ArrayLike | None = None,
    embedder: Embedder | None = None,
    *,
    vertices: int | None = None,
    faces: int | None = None,
    error: Length | str | float | None = None,
    watertight: bool | None = None,
    fill_holes: Length | str | float | None = None,
    orient: str | None = None,
    denoise: str | None = None,
    embedding: str | None = None,
    seed: int | None = None,
    threads: int | None = None,
    classes: Iterable[int] | str | None = None,
    texture: int | None = None,
    attributes: Mapping[str, ArrayLike] | None = None,
) -> Reconstruction:
    """Make a compact anisotropic triangle mesh of a point cloud.

    Parameters from `vertices` to `texture` are the common ones among the options, and overrule `options`, where all
    others are.

    Parameters
    ----------
    points
        (n, 3) in any unit and frame, an array or a tensor; what is not finite or occurs twice is dropped. Or a cloud
        that brings its normals and attributes: as ``hdpea.read`` returns it, a cloud or mesh of Open3D, trimesh or
        PyVista, a table with columns x, y and z (a structured array, such as PDAL's, or pandas').
    normals
        (n, 3) of any length and sign; estimated where missing, zero or not finite.
    options
        All stages' options.
    progress
        Called with a phase of ``PHASES`` and the fraction of it done; returning False cancels.
    sensors
        (n, 3), from where each point was seen: decides which side is out unless the normals' own signs do.
    embedder
        An embedding of your own, in place of the one that the options name.
    vertices, faces
        How many are wanted; one of the two. Default: one vertex for every 8 points, fewer if their noise
        hides what these would show.
    error
        As few triangles as keep within this length of the points, both ways: in world units, or text such as ``"1%"``
        of the diagonal. `vertices` or `faces` are then the most there may be.
    watertight
        Whether to close every hole, whatever its size. Default: False.
    fill_holes
        Fill holes up to this size across: a length in world units, or text such as ``"1%"`` of the diagonal.
    orient
        Which side is out: ``"auto"`` (default), ``"wnnc"``, ``"mst"``, ``"file"`` or ``"viewpoint"``.
    denoise
        ``"auto"`` (default), ``"none"`` or ``"mls"``.
    embedding
        ``"direct"`` (default) or ``"learned"``.
    seed
        Of everything random; the same seed gives the same bytes. Default: 0.
    threads
        To use; 0 (default): all cores. The result is the same for any number.
    classes
        Take only the points of these classes: ``[2, 6]`` or ``"2,6"``. Default: all points.
    texture
        Make an image of the colours of the points, of so many pixels each way. Default: none.
    attributes
        (n,) or (n, c) by name, of points given as an array: what the vertices are to have, too. Colours are red, green
        and blue, or `colors` (n, 3).

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal, on a line, or hold no triangle.
    UsageError
        If the arrays are not of these shapes, an option is illegal, more vertices are asked for than there are
        points, a viewpoint is asked for and there is none, PyTorch is not installed, or has no such device.
    UnreadableInput
        If no point is finite, or the given normals, or their signs, are insisted on and unusable.
    Interrupted
        If `progress` cancelled.

    Examples
    --------
    >>> import numpy as np
    >>> directions = np.random.default_rng(0).normal(size=(2000, 3))
    >>> sphere = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    >>> mesh = reconstruct(sphere, vertices=200)
    >>> mesh.report.mesh.closed, len(mesh.vertices)
    (True, 200)
    """
    common = {
        "vertices": vertices,
        "faces": faces,
        "error": None if error is None else Length.of(error),
        "watertight": watertight,
        "fill_holes": None if fill_holes is None else Length.of(fill_holes),
        "orient": orient,
        "denoise": denoise,
        "embedding": embedding,
        "seed": seed,
        "threads": threads,
        "classes": None if classes is None else Classes.of(classes),
        "texture": texture,
    }
    given = {name: value for name, value in common.items() if value is not None}
    options = changed(options or Options(), given)
    check_pytorch()
    if options.embedding.device != EmbeddingOptions.device:
        torch_device(options.embedding.device)  # refused now, not when it is needed
    load_in_background()
    journal = Journal(options=options)
    clock = journal.clock
    with limited_threads(options.threads), core_errors_translated():
        cloud = cleaned_cloud(points, normals, sensors, attributes)
        if options.texture is not None:
            require_colors(cloud.attributes)
        with clock.stage("cleaning"):
            tell(progress, "cleaning", 0)
            found = surface_cloud(cloud, options.cleaning)
            # Nothing that is returned of the mesh is in the order of the points.
            cloud = found.in_order_of_space()
            tell(progress, "cleaning", 1)
        shown = found.points_shown
        per_vertex = len(cloud.points) / options.resolution_of(shown)
        prepared = prepare_surface(cloud, options.normals, options.denoising, per_vertex, progress, clock)
        budgeted, noise_choices = within_noise(options, prepared, shown)
        # Under an error bound the collapses find out themselves what the points show.
        exact = prepared.exact and not noise_choices and options.meshing.error is None
        _, count_choices = particles_wanted(budgeted, len(cloud.points), shown, exact=exact)
        surface, resolution = prepared.surface, budgeted.resolution_of(shown)
        with clock.stage("embedding"):
            embedded = embed_surface(surface, resolution, options.embedding, progress, embedder)
            per_vertex = len(cloud.points) / resolution
            bases = tangent_bases(embedded.coordinates, surface.normals, surface.neighbors, per_vertex)
        mesh = assemble_mesh(surface, embedded.coordinates, bases, budgeted, progress, clock, shown, exact=exact)
        # Before any piece is turned, as its points are not.
        carried = _carried(mesh, surface, cloud, clock)
        texture_of_points = _texture(mesh, surface, cloud, options.texture, clock)
        levels = _levels(mesh, prepared, options, cloud, journal)
        faced = facing_out(mesh) if prepared.oriented.computed_sides else FacedMesh(mesh)
        mesh = faced.mesh
        wanted = budgeted.vertices_of(shown) if options.meshing.error is None else len(mesh.vertices_in_unit)
        measured = _measured(mesh, prepared, options.meshing, wanted, progress, clock)
    journal.source |= {"format": cloud.format} | ({} if cloud.crs is None else {"crs": cloud.crs})
    journal.counts |= cloud.counts() | found.counts() | {"normals_estimated": prepared.oriented.estimated}
    journal.choices += device_choices(options.embedding.device)
    journal.choices += [*prepared.choices, *noise_choices, *count_choices, *embedded.choices, *mesh.choices]
    journal.meshing |= mesh.statistics
    compared = measured.comparison
    coarse = coarseness(compared.distances, surface.frame.diagonal, options.meshing)
    about_mesh = [*faced.notes, *coarse, *compared.missing_part()]
    journal.notes += [*cloud.notes, *found.notes, *prepared.notes, *about_mesh]
    targets = missed_targets(mesh, measured.facts, options.meshing)
    journal.missed += [*prepared.missed, *targets, *measured.error.missed(), *compared.agreement.missed()]
    report = Report.of(
        journal, measured.facts, compared.distances, compared.agreement, measured.error, compared.along_z
    )
    return Reconstruction(
        surface.frame.to_world(mesh.vertices_in_unit),
        mesh.faces,
        report,
        found.dropped,
        carried,
        cloud.crs,
        texture_of_points,
        levels,
    )


class _Measured(NamedTuple):
    """What is found about a mesh in the end."""

    facts: MeshFacts
    comparison: Comparison
    error: AchievedError


def _measured(
    mesh: Mesh,
    prepared: Preparation,
    meshing: MeshingOptions,
    wanted: int,
    progress: ProgressCallback | None,
    clock: StageClock,
) -> _Measured:
    """Measure a mesh against the points that it was made of, of which so many vertices were `wanted`."""
    with clock.stage("measuring"):
        tell(progress, "measuring", 0)
        facts = mesh_facts(mesh)
        comparison = compare(mesh, prepared, wanted)
        given = prepared.oriented.surface
        error = achieved_error(mesh, prepared.surface, given, meshing.error, comparison.of_embedded)
        tell(progress, "measuring", 1)
    return _Measured(facts, comparison, error)


def _levels(
    mesh: Mesh, prepared: Preparation, options: Options, cloud: PointCloud, journal: Journal
) -> tuple[Level, ...]:
    """Return the coarser levels of a mesh; a stage, and in the journal, only where there are any."""
    if options.meshing.lod == 1:
        return ()
    made, surface = list[Level](), prepared.surface
    with journal.clock.stage("levels"):
        for each in coarser_levels(mesh, surface, options):
            faces = (facing_out(each).mesh if prepared.oriented.computed_sides else each).faces
            attributes = vertex_attributes(each, surface, cloud.attributes)
            made.append(Level(surface.frame.to_world(each.vertices_in_unit), faces, attributes))
            journal.levels.append(level_facts(each, prepared))
    return tuple(made)


def _carried(mesh: Mesh, surface: Surface, cloud: PointCloud, clock: StageClock) -> dict[str, NDArray[Any]]:
    """Return the attributes of a cloud at the vertices of its mesh; a stage only where there are any."""
    if not cloud.attributes:
        return {}
    with clock.stage("attributes"):
        return vertex_attributes(mesh, surface, cloud.attributes)


def _texture(mesh: Mesh, surface: Surface, cloud: PointCloud, size: int | None, clock: StageClock) -> Texture | None:
    """Return the texture, if one is asked for."""
    colors, _ = split_colors(cloud.attributes)
    if size is None or colors is None:
        return None
    with clock.stage("texture"):
        return texture_of(mesh, surface, colors, size)
