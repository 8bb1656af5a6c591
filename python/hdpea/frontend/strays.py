# SPDX-License-Identifier: GPL-3.0-or-later
"""Strays: points that lie farther from their neighbours than these lie from theirs, or off the plane that they show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

REACHES = (12, 24)
"""Numbers of nearest points that a point's distance to the last of is compared; small heaps of strays need the more."""

SPARSE, FAR_REACH = 3.0, 96
"""How many times farther than most a point's neighbours are where it is compared once more, over so many of them.

Of 200 strays in the box of a flat pair of scissors 24 lay so near each other that they were each other's company."""

FARTHER = 2.0
"""How many times farther than theirs: of 40,000 points spread at random over a surface none comes to it."""

SURROUNDINGS = 0.25
"""Quantile of the neighbours' distances that it is compared with: a quarter of them may tell, the others be strays."""

PLANE_POINTS = 12
"""Nearest points whose plane, fitted without the point itself, it lies off."""

OFF_THE_PLANE, OFF_THE_REST = 1.5, 3.0
"""How far off, in spacings there, and in standard deviations of the others: one of 100,000 points on a surface is.

Both, since at an edge points lie off the plane of others that do so too, and on a thin strut spacings mean little."""

LEAST_DEVIATION = 0.3
"""Least standard deviation that the others are granted, in spacings: of twelve points it may be small by chance."""

COMPANY = 4
"""Others, of the 24 nearest, that lie as far off the plane on the same side, of which one makes no stray.

They are the other side of a thin wall, of which the nearest twelve may have none by chance."""

FARTHER_FROM_LINES = 4.0
"""How many times farther, of points on lines: those that the last line crosses a corner by lie twice as far apart."""

ROUNDS = 20
"""Most rounds: each lays open what hid behind the strays of the one before, and most clouds are settled after five."""


def find_strays(points: NDArray[np.float64], on_lines: bool = False) -> NDArray[np.bool_]:
    """Return which points (n, 3) are strays, (n,) bool: not one in ten thousand where there are none.

    A point is a stray where its 12th or 24th nearest point is twice as far away as the same is from the points around
    it (statistical outlier removal, Rusu et al., "Towards 3D point cloud based object maps for household environments",
    2008; local, as in Breunig et al., "LOF", 2000, so that no cloud is too uneven), where points
    are sparse also by the 96th, or where it lies off the plane of its nearest points as none of these does. Strays once
    found say nothing about others; so it is repeated without them until no more are found. Neither moving, turning nor
    scaling the cloud makes a difference.

    Of points `on_lines`, where the plane of the nearest means nothing, only those count that lie four times as far.

    Clouds of fewer than 25 points are too small for strays.
    """
    left = np.arange(len(points))
    for _ in range(ROUNDS):
        if len(left) <= max(REACHES):
            break
        found = _stand_out(np.ascontiguousarray(points[left]), on_lines)
        if not found.any():
            break
        left = left[~found]
    strays = np.ones(len(points), dtype=bool)
    strays[left] = False
    return strays


def _stand_out(points: NDArray[np.float64], on_lines: bool) -> NDArray[np.bool_]:
    """Return which points (n, 3) stand out from those around them, (n,) bool."""
    nearest = _core.nearest_neighbors(points, max(REACHES))
    offsets = points[nearest] - points[:, None]  # (n, k, 3)
    distances = np.sqrt(np.einsum("nkc,nkc->nk", offsets, offsets))
    far = np.zeros(len(points), dtype=bool)
    farther = FARTHER_FROM_LINES if on_lines else FARTHER
    for count in REACHES:
        far |= distances[:, count - 1] > farther * _around(distances[:, count - 1], nearest[:, :count])
    reached = distances[:, -1]
    sparse = np.flatnonzero(~far & (reached > SPARSE * np.median(reached)))
    if len(sparse) and len(points) > FAR_REACH:
        far[sparse] = _lie_far_off(points, sparse, farther)
    if on_lines:
        return far
    # A disk that reaches to the k-th neighbour holds k points.
    spacing = _around(distances[:, PLANE_POINTS - 1], nearest[:, :PLANE_POINTS]) * np.sqrt(np.pi / PLANE_POINTS)
    return far | _off_the_plane(offsets, spacing)


def _lie_far_off(points: NDArray[np.float64], rows: NDArray[np.int64], farther: float) -> NDArray[np.bool_]:
    """Return which of the `rows` of points (n, 3) stand out over the far reach, (rows,) bool."""
    nearest = _core.nearest_neighbors(points, np.ascontiguousarray(points[rows]), FAR_REACH + 1)[:, 1:]
    asked, at = np.unique(np.concatenate([rows[:, None], nearest], axis=1), return_inverse=True)
    places = np.ascontiguousarray(points[asked])
    last = _core.nearest_neighbors(points, places, FAR_REACH + 1)[:, -1]
    reached = np.linalg.norm(points[last] - places, axis=1)[at.reshape(len(rows), -1)]
    return np.asarray(reached[:, 0] > farther * np.quantile(reached[:, 1:], SURROUNDINGS, axis=1))


def _around(values: NDArray[np.float64], nearest: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return a low quantile of the values (n,) of each point's `nearest` (n, k)."""
    return np.asarray(np.quantile(values[nearest], SURROUNDINGS, axis=1))


def _off_the_plane(offsets: NDArray[np.float64], spacing: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return where the origin lies off the plane of the nearest of the `offsets` (n, k, 3), as few of these do."""
    nearest = offsets[:, :PLANE_POINTS]
    middle = nearest.mean(axis=1)
    around = nearest - middle[:, None]
    variances, axes = np.linalg.eigh(around.swapaxes(1, 2) @ around / PLANE_POINTS)
    below = np.einsum("nc,nc->n", middle, axes[:, :, 0])
    height = abs(below)
    deviation = np.maximum(np.sqrt(np.maximum(variances[:, 0], 0)), LEAST_DEVIATION * spacing)
    off: NDArray[np.bool_] = (height > OFF_THE_PLANE * spacing) & (height > OFF_THE_REST * deviation)
    rows = np.flatnonzero(off)
    # Those nearer to the parallel plane through the point than to the plane itself.
    heights = np.einsum("nkc,nc->nk", offsets[rows], axes[rows, :, 0]) / below[rows, None]
    off[rows[(heights < 0.5).sum(axis=1) >= COMPANY]] = False
    return off
