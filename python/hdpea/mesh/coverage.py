# SPDX-License-Identifier: GPL-3.0-or-later
"""Candidate triangles without points of the cloud below them: where it is open, cells meet across the gap."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.mesh.particles import Particles
from hdpea.runtime.blocks import in_blocks
from hdpea.surface.surface import Surface, area_shown

MAX_GAP = 1.0
"""Farthest from the points that a triangle's middle, or that of an edge, may be, in spacings in R^3 of the vertices
that the points can show."""

POINTS_BELOW = 12
"""Nearest points to each of these places of which one must face as the triangle's corners do."""

SPARSE_NEIGHBOR = 7
"""Index of the neighbour within whose distance points count as near each other, where they are sparser than that."""

MIDDLES = np.array([[2, 1, 1], [1, 2, 1], [1, 1, 2], [2, 2, 0], [0, 2, 2], [2, 0, 2]]) / 4
"""Barycentric coordinates of the places of a triangle that are looked at."""


def covered(
    candidates: _core.Candidates, particles: Particles, surface: Surface, resolution: int | None = None
) -> _core.Candidates:
    """Return the candidates that lie on points of the surface, which face as their corners do.

    The disks that cells are cut from have their size in R^8; where the surface is stretched much, they reach across
    gaps of the cloud in R^3, which are not stretched. So do those of the few points, far from each other, whose
    normals were turned the wrong way, across all that lies between them.
    """
    positions = np.ascontiguousarray(particles.coordinates[:, :3])
    corners = candidates.triangles
    towards = surface.normals[particles.nearest][corners].sum(axis=1)  # (t, 3)
    farthest = _reach(particles, surface, resolution or len(particles.nearest))[corners].max(axis=1)  # (t,)
    chosen = np.ones(len(corners), dtype=bool)
    places = np.einsum("wc,tcx->twx", MIDDLES, positions[corners]).reshape(-1, 3)
    of = np.repeat(np.arange(len(corners)), len(MIDDLES))
    # The nearest point alone settles it for nearly all.
    doubtful = np.flatnonzero(~_lie_on(surface, places, towards[of], farthest[of], 1))
    of = of[doubtful]
    still = _lie_on(surface, places[doubtful], towards[of], farthest[of], POINTS_BELOW)
    chosen[of[~still]] = False
    return _core.Candidates(corners[chosen], candidates.counts[chosen], candidates.cell_areas)


def _lie_on(
    surface: Surface,
    places: NDArray[np.float64],
    towards: NDArray[np.float64],
    farthest: NDArray[np.float64],
    count: int,
) -> NDArray[np.bool_]:
    """Return whether one of the `count` nearest points to each place (t, 3) is near enough (t,) and faces `towards`."""
    below = _core.nearest_neighbors(surface.points_in_unit, places, count)  # (t, k)

    def lie(rows: slice) -> NDArray[np.bool_]:
        offsets = surface.points_in_unit[below[rows]] - places[rows, None]
        near = np.einsum("tkx,tkx->tk", offsets, offsets) <= farthest[rows, None] ** 2
        facing = np.einsum("tkx,tx->tk", surface.normals[below[rows]], towards[rows]) > 0
        return np.asarray((near & facing).any(axis=1))

    return in_blocks(lie, len(places))


def _reach(particles: Particles, surface: Surface, resolution: int) -> NDArray[np.float64]:
    """Return how far from points the surface around each particle (m,) may be."""
    points, nearest = surface.points_in_unit, particles.nearest
    spacing = float(np.sqrt(area_shown(points, surface.neighbors) / resolution))
    apart = surface.neighbors[nearest, SPARSE_NEIGHBOR]
    sparse = np.where(apart < 0, 0, np.linalg.norm(points[apart] - points[nearest], axis=1))
    return np.maximum(MAX_GAP * spacing, sparse)
