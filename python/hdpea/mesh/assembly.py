# SPDX-License-Identifier: GPL-3.0-or-later
"""From an embedded surface to its mesh: particles, extraction, refinement, simplification."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.mesh.budget import Budget
from hdpea.mesh.creases import align_to_creases, find_creases, with_crease_edges_counted
from hdpea.mesh.error_bound import ErrorBound, mended_within, simplify_within
from hdpea.mesh.extraction import Mesh, extract_mesh
from hdpea.mesh.particles import spread_particles
from hdpea.mesh.refinement import refine_mesh
from hdpea.mesh.repair import repair_mesh
from hdpea.mesh.simplification import simplify_mesh
from hdpea.options import Options
from hdpea.runtime.clock import StageClock
from hdpea.runtime.progress import ProgressCallback, of_phase, tell
from hdpea.surface.surface import Surface

ATTEMPTS = 3
"""How often at most particles are spread, each time more of them, where their mesh has too few vertices."""


def assemble_mesh(
    surface: Surface,
    coordinates: NDArray[np.float64],
    bases: NDArray[np.float64],
    options: Options | None = None,
    progress: ProgressCallback | None = None,
    clock: StageClock | None = None,
    points_shown: int | None = None,
) -> Mesh:
    """Spread particles on an embedded surface, join them, fit the mesh to the points, and simplify it to its budget.

    Parameters
    ----------
    coordinates
        (n, d) float64: the embedding of the points of `surface`.
    bases
        (n, 2, d) float64: its tangent planes, as ``hdpea.embedding.tangents`` makes them.
    options
        Those of particles, meshing and refinement count here.
    progress
        Hears of the phases particles, meshing, refinement, simplification and repair.
    clock
        Measures them as stages.
    points_shown
        How many evenly spread points would show as much: what the numbers go by; default: those of the surface.

    Raises
    ------
    CannotReconstruct
        If no triangle can be made.
    Interrupted
        If `progress` cancels.
    """
    options, clock = options or Options(), clock or StageClock()
    points_shown = points_shown or len(surface.points_in_unit)
    mesh = _mesh_of_particles(surface, coordinates, bases, options, points_shown, progress, clock)
    with clock.stage("refinement"):
        creases = find_creases(surface)
        mesh = align_to_creases(mesh, creases)
        mesh = refine_mesh(mesh, surface, options.refinement, of_phase(progress, "refinement"))
    bound = None
    if options.meshing.error is not None:
        bound = ErrorBound(surface, surface.frame.length_to_unit(options.meshing.error))
        with clock.stage("simplification"):
            mesh = simplify_within(mesh, bound, of_phase(progress, "simplification"))
    if Budget.of(options.meshing).excess(mesh) > 0:
        with clock.stage("simplification"):
            mesh = simplify_mesh(mesh, surface, options.meshing, of_phase(progress, "simplification"))
        with clock.stage("refinement"):
            mesh = align_to_creases(mesh, creases)
            mesh = refine_mesh(mesh, surface, options.refinement, of_phase(progress, "refinement"))
    with clock.stage("repair"):
        tell(progress, "repair", 0)
        mesh = repair_mesh(mesh) if bound is None else mended_within(mesh, bound)
        tell(progress, "repair", 1)
    return with_crease_edges_counted(mesh, creases)


def _mesh_of_particles(
    surface: Surface,
    coordinates: NDArray[np.float64],
    bases: NDArray[np.float64],
    options: Options,
    points_shown: int,
    progress: ProgressCallback | None,
    clock: StageClock,
) -> Mesh:
    """Spread particles and join them; where that makes too few vertices, spread more."""
    count = options.particles_of(points_shown)
    share_kept = options.vertices_of(points_shown) / count
    attempts = list[Mesh]()
    while len(attempts) < ATTEMPTS:
        with clock.stage("particles"):
            particles = spread_particles(
                coordinates,
                bases,
                surface.neighbors,
                count,
                options=options.particles,
                progress=of_phase(progress, "particles"),
            )
        with clock.stage("meshing"):
            tell(progress, "meshing", 0)
            attempts.append(extract_mesh(particles, bases, surface, options.meshing, share_kept))
            tell(progress, "meshing", 1)
        excess = Budget.of(options.meshing).excess(attempts[-1])
        if excess >= 0:
            return attempts[-1]
        count = min(round(count / (1 + excess)), len(surface.points_in_unit))
    return max(attempts, key=lambda mesh: len(mesh.vertices_in_unit))
