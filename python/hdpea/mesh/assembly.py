# SPDX-License-Identifier: GPL-3.0-or-later
"""From an embedded surface to its mesh: particles, extraction, refinement, simplification, remeshing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea.mesh.budget import Budget
from hdpea.mesh.creases import find_creases, with_crease_edges_counted
from hdpea.mesh.error_bound import ErrorBound, mended_within, simplify_within
from hdpea.mesh.extraction import Mesh, extract_mesh
from hdpea.mesh.fitting import FitTarget
from hdpea.mesh.lids import without_lids
from hdpea.mesh.particles import spread_particles
from hdpea.mesh.repair import repair_mesh
from hdpea.options import MeshingOptions, Options, ParticleOptions
from hdpea.options.choice import Choice
from hdpea.options.particles import ITERATIONS, ITERATIONS_OF_MANY
from hdpea.options.points_shown import PointsShown
from hdpea.runtime.clock import StageClock
from hdpea.runtime.progress import ProgressCallback, of_phase, tell
from hdpea.surface.surface import Surface

ATTEMPTS = 3
"""How often at most particles are spread, each time more of them, where their mesh has too few vertices."""


@dataclass(frozen=True)
class _Counts:
    """Particles to spread, vertices to make of them, and how many the points can show."""

    particles: int
    vertices: int
    resolution: int

    @property
    def many(self) -> bool:
        return self.particles > self.vertices

    def wanted(self, asked: MeshingOptions) -> MeshingOptions:
        """Return what the mesh is to have in the end: these vertices where there are more particles, and none asked."""
        return replace(asked, vertices=self.vertices) if asked.any_size and self.many else asked


def assemble_mesh(
    surface: Surface,
    coordinates: NDArray[np.float64],
    bases: NDArray[np.float64],
    options: Options,
    progress: ProgressCallback | None = None,
    clock: StageClock | None = None,
    shown: PointsShown | None = None,
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
    shown
        What the points can show, which the numbers go by; default: as much as so many that are exact.

    Raises
    ------
    CannotReconstruct
        If no triangle can be made.
    Interrupted
        If `progress` cancels.
    """
    clock = clock or StageClock()
    shown = shown or PointsShown(len(surface.points_in_unit))
    counts = _Counts(
        options.particles_of(len(surface.points_in_unit), shown),
        options.vertices_of(shown.count),
        options.resolution_of(shown.count),
    )
    mesh = _mesh_of_particles(surface, coordinates, bases, options, counts, progress, clock, exact=shown.exact)
    reaches = shown.exact and counts.many and options.refinement.refine
    with clock.stage("refinement"):
        every_point = FitTarget(
            surface,
            coordinates,
            bases,
            find_creases(surface),
            options.refinement,
            progress,
            within_error=options.meshing.error is not None,
        )
        target = every_point.of_kept_pieces(mesh, counts.vertices)
        mesh = target.fitted(mesh)
        if reaches:
            mesh = target.reached(mesh, counts.resolution)
    if options.meshing.error is None:
        mesh = _within_budget(mesh, target, counts.wanted(options.meshing), clock, reaches=reaches)
        with clock.stage("repair"):
            tell(progress, "repair", 0)
            mesh = repair_mesh(mesh, target.surface.points_in_unit, exact=shown.exact)
    else:
        bound = ErrorBound(target.surface, surface.frame.length_to_unit(options.meshing.error))
        mesh = _within_error(mesh, target, bound, options.meshing, clock)
        with clock.stage("repair"):
            tell(progress, "repair", 0)
            mesh = mended_within(mesh, bound)
    tell(progress, "repair", 1)
    return with_crease_edges_counted(mesh, target.creases)


def _within_budget(mesh: Mesh, target: FitTarget, wanted: MeshingOptions, clock: StageClock, *, reaches: bool) -> Mesh:
    """Return the mesh with no more vertices or faces than are wanted, evened out and fitted anew if it had more."""
    if Budget.of(wanted).excess(mesh) <= 0:
        return mesh
    with clock.stage("simplification"):
        mesh = target.simplified(mesh, wanted)
    with clock.stage("remeshing"):
        mesh = target.remeshed(mesh)
    with clock.stage("refinement"):
        mesh = target.fitted(mesh)
        if not reaches:
            return mesh
        reached = target.reached(mesh, len(mesh.vertices_in_unit))
        more = len(reached.vertices_in_unit) > len(mesh.vertices_in_unit)
        return target.simplified(reached, wanted) if more else reached


def _within_error(mesh: Mesh, target: FitTarget, bound: ErrorBound, wanted: MeshingOptions, clock: StageClock) -> Mesh:
    """Return the mesh with as few faces as keep a bound, and no more than are wanted, which may break it."""
    with clock.stage("simplification"):
        mesh = simplify_within(mesh, bound, of_phase(target.progress, "simplification"))
    if Budget.of(wanted).excess(mesh) <= 0:
        return mesh
    with clock.stage("simplification"):
        mesh = target.simplified(mesh, wanted)
    with clock.stage("refinement"):
        return target.fitted(mesh)


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
    spreading, choices = spreading_options(options.particles, evened=counts.many and options.meshing.error is None)
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
            mesh = extract_mesh(particles, bases, surface, options.meshing, share_kept, counts.resolution, exact=exact)
            # A size that was asked for is kept to.
            chosen = options.meshing.fill_holes is None and not options.meshing.watertight
            mesh = without_lids(mesh, surface) if chosen else mesh
            attempts.append(replace(mesh, choices=(*choices, *mesh.choices)))
            tell(progress, "meshing", 1)
        # Under an error a size is the most there may be, which no attempt has to come to.
        excess = 0.0 if options.meshing.any_size else Budget.of(options.meshing).excess(attempts[-1])
        if excess >= 0:
            return attempts[-1]
        before, count = count, min(round(count / (1 + excess)), len(surface.points_in_unit))
        if count == before:
            break
    return max(attempts, key=lambda mesh: len(mesh.vertices_in_unit))


def spreading_options(options: ParticleOptions, *, evened: bool) -> tuple[ParticleOptions, tuple[Choice, ...]]:
    """Return the options with a number of steps: fewer if the mesh is `evened` out afterwards."""
    if options.iterations is not None:
        return options, ()
    steps = ITERATIONS_OF_MANY if evened else ITERATIONS
    why = f"their mesh is {'' if evened else 'not '}evened out afterwards"
    return replace(options, iterations=steps), (Choice("iterations", steps, "steps", why),)
