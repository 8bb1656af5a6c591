# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a mesh is from its points, and the smallest mesh that is no farther than an error."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.repair import repair_mesh
from hdpea.mesh.simplification import simplified
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.surface import Surface, disk_radii

PLACES = 100_000
"""Places of the mesh that are measured, besides its vertices."""

PLACES_AT_ONCE = 2_000
"""So few that what is worked out of them stays in the caches: twice as fast, and next to no memory."""

NEAREST, FEW_NEAREST = 24, 3
"""Points near a place of which one must show it: beside a crease most lie on the other side of it; and those that are
tried first."""

TIGHTENED = (0.98, 0.95, 0.85, 0.7)
"""Shares of the error that are tried one after the other, since places between those tried may be a little farther."""

HOPELESS = 2.0
"""By how many times the error a mesh breaks it that no tightening brings within: 0.7 of it is tried at the least.

Of eight thin training meshes at 0.5 and 0.1 % none that broke it by more came within it, nor nearer by a sixth."""

ROUNDING = 1 + 1e-6


@dataclass(frozen=True)
class ReachedError:
    """How far a mesh and its points are apart at most, in the unit frame or in the world.

    Attributes
    ----------
    points_to_mesh
        Largest distance of a point, after any denoising, from the mesh.
    mesh_to_points
        Largest distance of a place of the mesh from the disk of one of its ``NEAREST`` points: what lies across the
        point's normal, as far as its 12th neighbour. Patches of holes do not count.
    """

    points_to_mesh: float
    mesh_to_points: float

    @property
    def larger(self) -> float:
        """The larger of the two."""
        return max(self.points_to_mesh, self.mesh_to_points)

    def in_world(self, diagonal: float) -> ReachedError:
        """Return the same in world units, for a cloud of this diagonal."""
        return ReachedError(self.points_to_mesh * diagonal, self.mesh_to_points * diagonal)


@dataclass(frozen=True)
class ErrorBound:
    """An error that a mesh must keep from the points of a surface; lengths in the unit frame."""

    surface: Surface
    error: float

    @cached_property
    def radii(self) -> NDArray[np.float64]:
        """The radii (n,) of the points' disks."""
        return disk_radii(self.surface.points_in_unit, self.surface.neighbors)

    def reached(self, mesh: Mesh, places: int = PLACES, distances: NDArray[np.float64] | None = None) -> ReachedError:
        """Measure how far a mesh and the points are apart, whatever the error, at so many `places` of the mesh.

        `distances` (n,) of the points from the mesh save the search if they are known.
        """
        points = self.surface.points_in_unit
        if distances is None:
            distances = _core.closest_surface_points(mesh.vertices_in_unit, mesh.faces, points).distance
        return ReachedError(float(distances.max()), self._of_places(mesh, places))

    def kept_by(self, mesh: Mesh) -> bool:
        """Return whether a mesh keeps the error, but for rounding."""
        return self.reached(mesh).larger <= self.error * ROUNDING

    def _of_places(self, mesh: Mesh, count: int) -> float:
        """Return how far of `count` places of a mesh, and its vertices, one is from the disks of its nearest points."""
        places = mesh.vertices_in_unit
        if mesh_area(mesh.vertices_in_unit, mesh.faces) > 0:
            places = np.vstack([places, sample_surface(mesh.vertices_in_unit, mesh.faces, count).points])
        # Fewer disks than all of the nearest points' are no nearer: most places need no more to be known not to be the
        # farthest, and all others are tried in turn.
        few = self._nearest(places, FEW_NEAREST)
        at_most = np.concatenate(
            [self._of_disks(places[some], few[some]) for some in _in_parts(np.arange(len(places)))]
        )
        farthest = 0.0
        for some in _in_parts(np.argsort(-at_most, kind="stable")):
            if at_most[some[0]] <= farthest:
                break
            distances = self._of_disks(places[some], self._nearest(places[some], NEAREST))
            shown = ~on_patches(places[some], distances, mesh.patches)
            farthest = float(distances[shown].max(initial=farthest))
        return farthest

    def _nearest(self, places: NDArray[np.float64], count: int) -> NDArray[np.int64]:
        """Return the `count` nearest points (p, count) to places (p, 3)."""
        points = self.surface.points_in_unit
        return _core.nearest_neighbors(points, places, min(count, len(points)))

    def _of_disks(self, places: NDArray[np.float64], nearest: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the distance (p,) of places (p, 3) from the disk of that of their `nearest` (p, k) that shows it."""
        offsets = places[:, None] - self.surface.points_in_unit[nearest]
        heights = np.einsum("pkc,pkc->pk", offsets, self.surface.normals[nearest])
        aside = np.sqrt(np.maximum(np.einsum("pkc,pkc->pk", offsets, offsets) - heights**2, 0))
        beyond = np.maximum(aside - self.radii[nearest], 0)
        return np.asarray(np.sqrt((heights**2 + beyond**2).min(axis=1)))


def _in_parts(rows: NDArray[np.int64]) -> Iterator[NDArray[np.int64]]:
    """Yield rows (p,) in parts of ``PLACES_AT_ONCE``."""
    for first in range(0, len(rows), PLACES_AT_ONCE):
        yield rows[first : first + PLACES_AT_ONCE]


def on_patches(
    places: NDArray[np.float64], near: NDArray[np.float64], patches: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which places (m, 3) lie nearer than `near` (m,) to patches (k, 3, 3): they may have moved since."""
    if not len(places) or not len(patches):
        return np.zeros(len(places), dtype=bool)
    corners = np.arange(3 * len(patches)).reshape(-1, 3)
    found = _core.closest_surface_points(patches.reshape(-1, 3), corners, places)
    return np.asarray(found.distance <= near)


def mended_within(mesh: Mesh, bound: ErrorBound) -> Mesh:
    """Return the mesh without its self-intersections, unless that would break an error that it keeps."""
    mended = repair_mesh(mesh, bound.surface.points_in_unit)
    return mended if bound.kept_by(mended) or not bound.kept_by(mesh) else mesh


def simplify_within(mesh: Mesh, bound: ErrorBound, progress: PhaseCallback | None = None) -> Mesh:
    """Return the mesh with edges collapsed as long as it keeps an error, both ways.

    Where the result does not quite keep it, a smaller one is tried; what comes nearest to the error is returned.
    """
    attempts = list[tuple[float, Mesh]]()
    with core_errors_translated():
        for share in TIGHTENED:
            small = _core.simplify_within(
                mesh.vertices_in_unit,
                mesh.coordinates,
                mesh.faces,
                bound.surface.points_in_unit,
                bound.surface.normals,
                bound.radii,
                share * bound.error,
                progress,
            )
            made = simplified(mesh, small)
            attempts.append((bound.reached(made).larger, made))
            if attempts[-1][0] <= bound.error * ROUNDING:
                return made
            if attempts[-1][0] > bound.error * HOPELESS:
                break
    return min(attempts, key=lambda attempt: attempt[0])[1]
