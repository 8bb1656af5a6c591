# SPDX-License-Identifier: GPL-3.0-or-later
"""From an embedded surface to its mesh: particles, extraction, refinement, simplification, remeshing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.anisotropic_remeshing import remesh_anisotropically
from hdpea.mesh.budget import Budget
from hdpea.mesh.creases import align_to_creases, find_creases, with_crease_edges_counted
from hdpea.mesh.error_bound import ErrorBound, mended_within, simplify_within
from hdpea.mesh.extraction import Mesh, extract_mesh
from hdpea.mesh.particles import spread_particles
from hdpea.mesh.reaching import reach_points
from hdpea.mesh.refinement import refine_mesh
from hdpea.mesh.repair import repair_mesh
from hdpea.mesh.simplification import simplify_mesh
from hdpea.options import Options, ParticleOptions
from hdpea.options.particles import ITERATIONS, ITERATIONS_OF_MANY
from hdpea.runtime.clock import StageClock
from hdpea.runtime.progress import ProgressCallback, of_phase, tell
from hdpea.surface.surface import MIN_POINTS, Surface

ATTEMPTS = 3
"""How often at most particles are spread, each time more of them, where their mesh has too few vertices."""

LEFT_OUT = 2.0
"""Distance from the mesh, in spacings of its vertices, from which points do not draw it where pieces were dropped.

They are those of these pieces: of CGAL's hippo1 and hippo2 they drew a spike out of a foot."""


@dataclass(frozen=True)
class _Counts:
    """Particles to spread, vertices to make of them, and how many the points can show."""

    particles: int
    vertices: int
    resolution: int

    @property
    def many(self) -> bool:
        return self.particles > self.vertices


def assemble_mesh(
    surface: Surface,
    coordinates: NDArray[np.float64],
    bases: NDArray[np.float64],
    options: Options | None = None,
    progress: ProgressCallback | None = None,
    clock: StageClock | None = None,
    points_shown: int | None = None,
    *,
    exact: bool = True,
) -> Mesh:
    """Spread particles on an embedded surface, join them, fit the mesh to the points, and simplify it to its budget.

    Parameters
    ----------
    coordinates
        (n, d) float64: the embedding of the points of `surface`.
    bases
        (n, 2, d) float64: its tangent planes, as ``hdpea.embedding.tangents`` makes them.
    options
        Those of particles, meshing and refinement count here, and the device of the embedding.
    progress
        Hears of the phases particles, meshing, refinement, simplification, remeshing and repair.
    clock
        Measures them as stages.
    points_shown
        How many evenly spread points would show as much: what the numbers go by; default: those of the surface.
    exact
        Whether the points are free of noise, and their normals their own: then more particles show more.

    Raises
    ------
    CannotReconstruct
        If no triangle can be made.
    Interrupted
        If `progress` cancels.
    """
    options, clock = options or Options(), clock or StageClock()
    points_shown = points_shown or len(surface.points_in_unit)
    counts = _Counts(
        min(options.particles_of(points_shown, exact=exact), len(surface.points_in_unit)),
        options.vertices_of(points_shown),
        options.resolution_of(points_shown),
    )
    mesh = _mesh_of_particles(surface, coordinates, bases, options, counts, progress, clock, exact=exact)
    with clock.stage("refinement"):
        creases = find_creases(surface)
        kept = _points_of_kept_pieces(mesh, surface, counts.vertices)
        if kept is not None:
            surface = Surface.of(surface.frame, surface.points_in_unit[kept], surface.normals[kept])
            coordinates, bases = coordinates[kept], bases[kept]
        mesh = align_to_creases(mesh, creases)
        mesh = refine_mesh(mesh, surface, options.refinement, of_phase(progress, "refinement"))
        reaches = exact and counts.many and options.refinement.refine
        if reaches:
            mesh = reach_points(mesh, surface, coordinates, counts.resolution)
    bound = None
    if options.meshing.error is not None:
        bound = ErrorBound(surface, surface.frame.length_to_unit(options.meshing.error))
        with clock.stage("simplification"):
            mesh = simplify_within(mesh, bound, of_phase(progress, "simplification"))
    wanted = options.meshing
    if wanted.any_size and wanted.error is None and counts.many:
        wanted = replace(wanted, vertices=counts.vertices)
    if Budget.of(wanted).excess(mesh) > 0:
        with clock.stage("simplification"):
            mesh = simplify_mesh(mesh, surface, wanted, of_phase(progress, "simplification"))
        if bound is None:
            with clock.stage("remeshing"):
                mesh = remesh_anisotropically(mesh, surface, coordinates, bases, of_phase(progress, "remeshing"))
        with clock.stage("refinement"):
            mesh = align_to_creases(mesh, creases)
            mesh = refine_mesh(mesh, surface, options.refinement, of_phase(progress, "refinement"))
            if reaches and bound is None:
                fitted = mesh
                mesh = reach_points(fitted, surface, coordinates, len(fitted.vertices_in_unit))
                if len(mesh.vertices_in_unit) > len(fitted.vertices_in_unit):
                    mesh = simplify_mesh(mesh, surface, wanted)
    with clock.stage("repair"):
        tell(progress, "repair", 0)
        mesh = repair_mesh(mesh, surface.points_in_unit, exact=exact) if bound is None else mended_within(mesh, bound)
        tell(progress, "repair", 1)
    return with_crease_edges_counted(mesh, creases)


def _points_of_kept_pieces(mesh: Mesh, surface: Surface, vertices: int) -> NDArray[np.int64] | None:
    """Return the rows (m,) of the points that are not of pieces dropped from a mesh of so many vertices in the end.

    None if all are kept.
    """
    if not mesh.statistics.get("dropped_components"):
        return None
    spacing = np.sqrt(mesh_area(mesh.vertices_in_unit, mesh.faces) / vertices)
    distances = _core.closest_surface_points(mesh.vertices_in_unit, mesh.faces, surface.points_in_unit).distance
    kept = np.flatnonzero(distances <= LEFT_OUT * spacing)
    return kept if MIN_POINTS <= len(kept) < len(distances) else None


def _mesh_of_particles(
    surface: Surface,
    coordinates: NDArray[np.float64],
    bases: NDArray[np.float64],
    options: Options,
    counts: _Counts,
    progress: ProgressCallback | None,
    clock: StageClock,
    *,
    exact: bool,
) -> Mesh:
    """Spread particles and join them; where that makes too few vertices, spread more."""
    count, share_kept = counts.particles, counts.vertices / counts.particles
    spreading = _spreading(options.particles, evened=counts.many and options.meshing.error is None)
    attempts = list[Mesh]()
    while len(attempts) < ATTEMPTS:
        with clock.stage("particles"):
            tell(progress, "particles", 0)
            particles = spread_particles(
                coordinates,
                bases,
                surface.neighbors,
                count,
                options=spreading,
                progress=of_phase(progress, "particles"),
                device=options.embedding.device,
            )
        with clock.stage("meshing"):
            tell(progress, "meshing", 0)
            attempts.append(
                extract_mesh(particles, bases, surface, options.meshing, share_kept, counts.resolution, exact=exact)
            )
            tell(progress, "meshing", 1)
        excess = Budget.of(options.meshing).excess(attempts[-1])
        if excess >= 0:
            return attempts[-1]
        count = min(round(count / (1 + excess)), len(surface.points_in_unit))
    return max(attempts, key=lambda mesh: len(mesh.vertices_in_unit))


def _spreading(options: ParticleOptions, *, evened: bool) -> ParticleOptions:
    """Return the options with a number of steps: fewer if the mesh is `evened` out afterwards."""
    if options.iterations is not None:
        return options
    return replace(options, iterations=ITERATIONS_OF_MANY if evened else ITERATIONS)
