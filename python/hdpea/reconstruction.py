# SPDX-License-Identifier: GPL-3.0-or-later
"""All stages, one after the other: a cloud enters, a mesh leaves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.embedding import Embedder, embed_surface
from hdpea.embedding.tangents import tangent_bases
from hdpea.errors import HdpeaError, UsageError, core_errors_translated
from hdpea.mesh.budget import Budget
from hdpea.mesh.extraction import Mesh, extract_mesh
from hdpea.mesh.particles import spread_particles
from hdpea.mesh.refinement import refine_mesh
from hdpea.mesh.simplification import simplify_mesh
from hdpea.options import Options
from hdpea.options.choice import Choice
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.reading.cloud import PointCloud, cleaned, from_arrays
from hdpea.report.report import Distances, MeshFacts, Report
from hdpea.runtime.progress import ProgressCallback, of_phase, tell
from hdpea.runtime.threads import limited_threads
from hdpea.surface.denoising import denoised
from hdpea.surface.normals import OrientedSurface, oriented_surface
from hdpea.surface.orientation import TRUSTED_CONSISTENCY
from hdpea.surface.surface import Surface

PHASES = ("normals", "denoising", "embedding", "particles", "meshing", "refinement", "simplification", "measuring")
"""The phases that ``progress`` hears of, in order; of denoising only if there is noise, or it is asked for, and of
simplification, and another refinement after it, only if fewer vertices are wanted than particles are spread."""

ATTEMPTS = 3
"""How often the particles are counted anew where they make too few vertices."""


@dataclass(frozen=True)
class Reconstruction:
    """A mesh, and the report of how it was made.

    Attributes
    ----------
    vertices
        (v, 3) float64 in world units.
    faces
        (f, 3) int64, counter-clockwise seen from outside. Edge- and vertex-manifold.
    report
        What was asked, chosen, found and measured.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    report: Report


def reconstruct(
    points: NDArray[np.float64],
    normals: NDArray[np.float64] | None = None,
    options: Options | None = None,
    progress: ProgressCallback | None = None,
    sensors: NDArray[np.float64] | None = None,
    embedder: Embedder | None = None,
) -> Reconstruction:
    """Make a compact anisotropic triangle mesh of a point cloud.

    Parameters
    ----------
    points
        (n, 3) in any unit and frame; what is not finite or occurs twice is dropped.
    normals
        (n, 3) of any length and sign; estimated where missing, zero or not finite.
    options
        All stages' options.
    progress
        Called with a phase of ``PHASES`` and the fraction of it done; returning False cancels.
    sensors
        (n, 3), from where each point was seen; needed only to orient by viewpoint.
    embedder
        An embedding of your own, in place of the one that the options name.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal, on a line, or hold no triangle.
    UsageError
        If the arrays are not of these shapes, more vertices are asked for than there are points, or a viewpoint
        is asked for and there is none.
    UnreadableInput
        If the given normals, or their signs, are insisted on and unusable.
    Interrupted
        If `progress` cancelled.

    Examples
    --------
    >>> import numpy as np
    >>> directions = np.random.default_rng(0).normal(size=(2000, 3))
    >>> sphere = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    >>> mesh = reconstruct(sphere)
    >>> mesh.report.mesh.closed
    True
    """
    options = options or Options()
    report = Report(options)
    with limited_threads(options.threads), core_errors_translated():
        cloud = cleaned(from_arrays(points, normals, sensors))
        with report.clock.stage("normals"):
            per_particle = len(cloud.points) / options.particles_of(len(cloud.points))
            oriented = oriented_surface(
                cloud.points, cloud.normals, options.normals, per_particle, progress, cloud.sensors()
            )
        _tell_of_cloud(report, cloud, oriented)
        with report.clock.stage("denoising"):
            surface, choices = denoised(oriented, options.denoising, progress)
            report.choices += choices
        mesh = _mesh_of(surface, report, progress, embedder)
        with report.clock.stage("measuring"):
            tell(progress, "measuring", 0)
            _measure(mesh, oriented.surface, report)
            tell(progress, "measuring", 1)
    return Reconstruction(oriented.surface.frame.to_world(mesh.vertices_in_unit), mesh.faces, report)


def _tell_of_cloud(report: Report, cloud: PointCloud, oriented: OrientedSurface) -> None:
    report.counts |= cloud.counts() | {"normals_estimated": oriented.estimated}
    report.choices += oriented.choices
    report.notes += cloud.notes
    if oriented.estimated > cloud.unusable_normals:
        report.notes.append(f"Normals of {oriented.estimated:,} points were estimated.")
    if oriented.reoriented and oriented.consistency is not None and oriented.consistency < TRUSTED_CONSISTENCY:
        share = f"{oriented.consistency:.0%} of neighbours agreed"
        report.notes.append(f"The given normals point both ways ({share}); they were oriented anew.")


def _mesh_of(surface: Surface, report: Report, progress: ProgressCallback | None, embedder: Embedder | None) -> Mesh:
    """Embed, spread, join and fit the mesh; simplify it where it has more vertices than are wanted."""
    options = report.options
    mesh = _mesh_of_particles(surface, report, progress, embedder)
    with report.clock.stage("refinement"):
        mesh = refine_mesh(mesh, surface, options.refinement, of_phase(progress, "refinement"))
    if Budget.of(options.meshing).excess(mesh) > 0:
        with report.clock.stage("simplification"):
            mesh = simplify_mesh(mesh, options.meshing, of_phase(progress, "simplification"))
        with report.clock.stage("refinement"):
            mesh = refine_mesh(mesh, surface, options.refinement, of_phase(progress, "refinement"))
    report.choices += mesh.choices
    report.meshing.update(mesh.statistics)
    return mesh


def _mesh_of_particles(
    surface: Surface, report: Report, progress: ProgressCallback | None, embedder: Embedder | None
) -> Mesh:
    """Embed, spread and join; where that makes too few vertices, spread more particles."""
    options, points = report.options, len(surface.points_in_unit)
    wanted = _particles_wanted(report, points)
    with report.clock.stage("embedding"):
        embedded = embed_surface(surface, wanted, options.embedding, progress, embedder)
        bases = tangent_bases(embedded.coordinates, surface.normals, surface.neighbors, points / wanted)
    report.choices += embedded.choices
    left = options.vertices_of(points) / wanted
    count, attempts = wanted, list[Mesh]()
    while len(attempts) < ATTEMPTS:
        with report.clock.stage("particles"):
            particles = spread_particles(
                embedded.coordinates,
                bases,
                surface.neighbors,
                count,
                options=options.particles,
                progress=of_phase(progress, "particles"),
            )
        with report.clock.stage("meshing"):
            tell(progress, "meshing", 0)
            attempts.append(extract_mesh(particles, bases, surface, options.meshing, left))
            tell(progress, "meshing", 1)
        excess = Budget.of(options.meshing).excess(attempts[-1])
        if excess >= 0:
            return attempts[-1]
        count = min(round(count / (1 + excess)), points)
    return max(attempts, key=lambda mesh: len(mesh.vertices_in_unit))


def _particles_wanted(report: Report, points: int) -> int:
    options = report.options
    vertices, particles = options.vertices_of(points), options.particles_of(points)
    if particles > points:
        what = "vertices" if particles == vertices else "particles"
        raise UsageError(
            f"{particles} {what} were asked for, but there are {points} distinct points.",
            f"Ask for at most half as many {what} as there are points.",
        )
    if options.particles.particles is None:
        if options.meshing.any_size:
            report.choices.append(Choice("vertices", vertices, "", f"one for every {POINTS_PER_VERTEX} points"))
        elif particles > vertices:
            why = f"what {points:,} points can show; the mesh is simplified from these"
            report.choices.append(Choice("particles", particles, "", why))
    return particles


def _measure(mesh: Mesh, surface: Surface, report: Report) -> None:
    """Check the mesh and measure it against the points; a mesh that is not manifold never leaves."""
    check = _core.check_mesh(mesh.vertices_in_unit, mesh.faces)
    if not (check.manifold and check.oriented):
        raise HdpeaError("The mesh is not manifold.", "This is an error in hdpea: please report it with the input.")
    report.mesh = MeshFacts(
        vertices=check.vertices,
        faces=check.faces,
        manifold=check.manifold,
        closed=check.closed,
        components=check.components,
        boundary_loops=check.boundary_loops,
        genus=check.genus if check.closed else None,
        self_intersections=_core.count_self_intersections(mesh.vertices_in_unit, mesh.faces),
    )
    feet = _core.closest_surface_points(mesh.vertices_in_unit, mesh.faces, surface.points_in_unit)
    diagonal = surface.frame.diagonal
    report.distances = Distances.of(feet.distance * diagonal, surface.spacing * diagonal)
    excess = Budget.of(report.options.meshing).excess(mesh)
    if excess:
        report.missed.append(f"The budget was missed by {abs(excess):.1%}.")
    if report.options.meshing.watertight and not check.closed:
        report.missed.append(f"The mesh is not watertight: {check.boundary_loops} boundary loops are left.")
