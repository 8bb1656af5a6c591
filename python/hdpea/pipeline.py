# SPDX-License-Identifier: GPL-3.0-or-later
"""All stages, one after the other: a cleaned cloud enters, a mesh and its report leave."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from numpy.typing import NDArray

from hdpea.embedding import Embedder
from hdpea.embedding.device import device_choices
from hdpea.errors import CannotReconstruct
from hdpea.frontend.cleaning import SurfaceCloud, surface_cloud
from hdpea.frontend.vantage import with_sensor_found
from hdpea.geometry.texture import Texture
from hdpea.mesh.attributes import vertex_attributes
from hdpea.mesh.budget import particles_wanted
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.levels import coarser_levels
from hdpea.mesh.noise import error_within_noise, within_noise
from hdpea.mesh.parts import mesh_surface
from hdpea.mesh.sides import FacedMesh, facing_as_given, facing_out
from hdpea.mesh.texture import texture_of
from hdpea.options import Options
from hdpea.options.choice import Choice
from hdpea.options.points_shown import PointsShown
from hdpea.reading.attributes import split_colors
from hdpea.reading.cloud import PointCloud
from hdpea.report.achieved_error import achieved_error
from hdpea.report.measurement import coarseness, compare, level_facts, mesh_facts, missed_targets
from hdpea.report.report import Journal, Report
from hdpea.result import Level, Reconstruction
from hdpea.runtime.clock import StageClock
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.surface.preparation import Preparation, prepare_surface


@dataclass(frozen=True)
class _Made:
    """A mesh, and what it was made of.

    Attributes
    ----------
    found
        What the front end found of the cloud.
    cloud
        The points that the mesh is of, in the order of `prepared`.
    prepared
        The same, with normals that point out.
    vertices
        How many were wanted.
    choices
        What was chosen automatically, after that of `prepared`.
    """

    found: SurfaceCloud
    cloud: PointCloud
    prepared: Preparation
    mesh: Mesh
    vertices: int
    choices: tuple[Choice, ...]


def reconstruct_cloud(
    cloud: PointCloud, options: Options, progress: ProgressCallback | None, embedder: Embedder | None
) -> Reconstruction:
    """Take a cleaned cloud, as ``hdpea.reading`` returns it, through all stages.

    `progress` and `embedder` are those of ``hdpea.reconstruct``, and so is what is raised.
    """
    journal = Journal(options=options)
    clock = journal.clock
    made = _make(cloud, options, progress, clock, embedder)
    # Before any piece is turned, as its points are not.
    carried = _carried(made, clock, progress)
    texture = _texture(made, options.texture, clock, progress)
    levels = _levels(made, journal, progress)
    faced = _facing_out(made.mesh, made.prepared)
    report = _report(made, faced, journal, progress)
    return Reconstruction(
        made.prepared.surface.frame.to_world(faced.mesh.vertices_in_unit),
        faced.mesh.faces,
        report,
        made.found.dropped,
        carried,
        cloud.crs,
        texture,
        levels,
    )


def _make(
    cloud: PointCloud,
    options: Options,
    progress: ProgressCallback | None,
    clock: StageClock,
    embedder: Embedder | None,
) -> _Made:
    """Clean, orient, embed and mesh a cloud."""
    with clock.stage("cleaning"):
        tell(progress, "cleaning", 0)
        found = surface_cloud(with_sensor_found(cloud), options.cleaning)
        # Nothing that is returned of the mesh is in the order of the points.
        cloud = found.in_order_of_space()
        tell(progress, "cleaning", 1)
    per_vertex = len(cloud.points) / options.resolution_of(found.points_shown)
    prepared = prepare_surface(cloud, options.normals, options.denoising, per_vertex, progress, clock)
    budgeted, noise_choices = within_noise(options, prepared, found.points_shown)
    # Under an error bound the collapses find out themselves what the points show.
    exact = prepared.exact and not noise_choices and options.meshing.error is None
    shown = PointsShown(found.points_shown, exact, prepared.denoised)
    _, count_choices = particles_wanted(budgeted, len(cloud.points), shown)
    surface, parts = prepared.surface, prepared.oriented.parts
    mesh, mesh_choices = mesh_surface(surface, budgeted, shown, parts, progress, clock, embedder)
    if len(mesh.faces) == 0:
        raise CannotReconstruct("No face is left of so few points.", "See that they lie on a surface.")
    wanted = budgeted.vertices_of(shown.count) if options.meshing.error is None else len(mesh.vertices_in_unit)
    own = () if embedder is None else (Choice("embedding", "given", "", "an embedder was passed"),)
    choices = (*noise_choices, *count_choices, *own, *mesh_choices, *mesh.choices)
    return _Made(found, cloud, prepared, mesh, wanted, choices)


def _facing_out(mesh: Mesh, prepared: Preparation) -> FacedMesh:
    """Turn closed pieces that face inwards, unless it is known from where they were seen."""
    sides = prepared.oriented
    if sides.method == "file":
        return facing_as_given(mesh)
    if not sides.computed_sides and not sides.from_above:
        return FacedMesh(mesh)
    faced = facing_out(mesh)
    # Open ones face up, which is no guess; closed ones may have none but vertical sides.
    return replace(faced, notes=()) if sides.from_above else faced


def _carried(made: _Made, clock: StageClock, progress: ProgressCallback | None) -> dict[str, NDArray[Any]]:
    """Return the attributes of a cloud at the vertices of its mesh; a stage only where there are any."""
    if not made.cloud.attributes:
        return {}
    with clock.stage("attributes"):
        tell(progress, "attributes", 0)
        return vertex_attributes(made.mesh, made.prepared.surface, made.cloud.attributes)


def _texture(made: _Made, size: int | None, clock: StageClock, progress: ProgressCallback | None) -> Texture | None:
    """Return the texture, if one is asked for."""
    colors, _ = split_colors(made.cloud.attributes)
    if size is None or colors is None:
        return None
    with clock.stage("texture"):
        tell(progress, "texture", 0)
        return texture_of(made.mesh, made.prepared.surface, colors, size)


def _levels(made: _Made, journal: Journal, progress: ProgressCallback | None) -> tuple[Level, ...]:
    """Return the coarser levels of a mesh; a stage, and in the journal, only where there are any."""
    if journal.options.meshing.lod == 1:
        return ()
    levels, surface = list[Level](), made.prepared.surface
    with journal.clock.stage("levels"):
        tell(progress, "levels", 0)
        for each in coarser_levels(made.mesh, surface, journal.options):
            faces = _facing_out(each, made.prepared).mesh.faces
            attributes = vertex_attributes(each, surface, made.cloud.attributes)
            levels.append(Level(surface.frame.to_world(each.vertices_in_unit), faces, attributes))
            journal.levels.append(level_facts(each, made.prepared))
    return tuple(levels)


def _report(made: _Made, faced: FacedMesh, journal: Journal, progress: ProgressCallback | None) -> Report:
    """Measure a mesh against the points that it was made of, and write down what was found on the way."""
    mesh, prepared, options = faced.mesh, made.prepared, journal.options
    with journal.clock.stage("measuring"):
        tell(progress, "measuring", 0)
        facts = mesh_facts(mesh)
        compared = compare(mesh, prepared, made.vertices)
        given = prepared.oriented.surface
        error = achieved_error(mesh, prepared.surface, given, options.meshing.error, compared.of_embedded)
        tell(progress, "measuring", 1)
    cloud, found = made.cloud, made.found
    journal.take_source(cloud.format, cloud.crs)
    journal.counts |= cloud.counts() | found.counts() | {"normals_estimated": prepared.oriented.estimated}
    journal.choices += [*device_choices(options.embedding.device), *prepared.choices, *made.choices]
    journal.meshing |= mesh.statistics
    size = [
        *coarseness(compared.distances, prepared.surface.frame.diagonal, options.meshing),
        *error_within_noise(options, prepared),
    ]
    journal.notes += [*cloud.notes, *found.notes, *prepared.notes, *faced.notes, *size, *compared.missing_part()]
    targets = missed_targets(mesh, facts, options.meshing)
    journal.missed += [*found.missed, *prepared.missed, *targets, *error.missed(), *compared.agreement.missed()]
    return Report.of(journal, facts, compared.distances, compared.agreement, error, compared.along_z)
