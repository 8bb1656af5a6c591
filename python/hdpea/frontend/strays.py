# SPDX-License-Identifier: GPL-3.0-or-later
"""Strays: points that lie farther from their neighbours than these lie from theirs, or off the plane that they show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.scattered import scattered
from hdpea.frontend.sheets import strays_in_sheets
from hdpea.frontend.standing import FARTHER, Standing, usual
from hdpea.geometry.covariances import covariances
from hdpea.geometry.thinning import rows_along
from hdpea.runtime.blocks import in_blocks

REACHES = (12, 24)
"""Numbers of nearest points that a point's distance to the last of is compared; small heaps of strays need the more."""

SPARSE, FAR_REACH = 3.0, 96
"""How many times farther than most a point's neighbours are where it is compared once more, over so many of them.

Of 200 strays in the box of a flat pair of scissors 24 lay so near each other that they were each other's company."""

PLANE_POINTS = 12
"""Nearest points whose plane, fitted without the point itself, it lies off."""

OFF_THE_PLANE, OFF_THE_REST = 1.5, 3.0
"""How far off, in spacings there, and in standard deviations of the others: one of 100,000 points on a surface is.

Both, since at an edge points lie off the plane of others that do so too, and on a thin strut spacings mean little."""

LEAST_DEVIATION = 0.3
"""Least standard deviation that the others are granted, in spacings: of twelve points it may be small by chance."""

SAMPLES, MOST_THICKNESS = 2_000, 0.45
"""Points at which it is looked whether there are planes to lie off, and the median ratio of the deviations of those
around across and along from which on there are none.

Noise of half a spacing has that; of a sphere's points with noise of a whole one 1 % would be strays, most of them
outside, and the two sides of what is left pass for walls."""

COMPANY = 4
"""Others, of the 24 nearest, that lie as far off the plane on the same side, of which one makes no stray.

They are the other side of a thin wall, of which the nearest twelve may have none by chance."""

FARTHER_FROM_LINES = 4.0
"""How many times farther, of points on lines: those that the last line crosses a corner by lie twice as far apart."""

ROUNDS = 20
"""Most rounds: each lays open what hid behind the strays of the one before, and most clouds are settled after five."""


def find_strays(points: NDArray[np.float64], nearest: NDArray[np.int64], on_lines: bool) -> NDArray[np.bool_]:
    """Return which points (n, 3) are strays, (n,) bool: not one in ten thousand where there are none.

    A point is a stray where its 12th or 24th nearest point is twice as far away as the same is from the points around
    it (statistical outlier removal, Rusu et al., "Towards 3D point cloud based object maps for household environments",
    2008; local, as in Breunig et al., "LOF", 2000, so that no cloud is too uneven), where points
    are sparse also by the 96th, or where it lies off the plane of its nearest points as none of these does. Strays once
    found say nothing about others; so it is repeated without them until no more are found. Neither moving, turning nor
    scaling the cloud makes a difference.

    What lies in a flat sheet of such points is none after all: where a surface is sampled several times more sparsely
    than beside, each round would take another strip of it.

    Of points `on_lines`, where the plane of the nearest means nothing, only those count that lie four times as far. Nor
    does it where noise is as wide as the points are apart.

    Parameters
    ----------
    nearest
        (n, 24) or more: the nearest other points of each.
    """
    standing = Standing(points, nearest[:, : max(REACHES)])
    while not on_lines and len(found := scattered(standing)):
        standing.drop(found)
    rows, planar = standing.rows, not on_lines and _show_planes(standing)
    farther = FARTHER_FROM_LINES if on_lines else FARTHER
    for _ in range(ROUNDS):
        found = _stand_out(standing, rows, farther, planar)
        if not len(found) or len(standing.rows) - len(found) <= max(REACHES):
            break
        rows = standing.drop(found)
    strays = ~standing.left
    if planar:
        strays[strays_in_sheets(points, nearest, strays)] = False
    return strays


def _stand_out(standing: Standing, rows: NDArray[np.int64], farther: float, planar: bool) -> NDArray[np.int64]:
    """Return which points stand out: of the `rows`, around which something changed, and of those that are sparse."""
    out = np.zeros(len(standing.points), dtype=bool)
    for count in REACHES:
        reached = standing.reached(count)
        out[rows] |= reached[rows] > farther * _around(reached, standing, rows, count)
    reached, left = standing.reached(max(REACHES)), standing.rows
    sparse = rows[~out[rows] & (reached[rows] > SPARSE * np.median(reached[left]))]
    if len(sparse) and len(left) > FAR_REACH:
        out[sparse] = _lie_far_off(standing.points, left, sparse, farther)
    if planar:
        # A disk that reaches to the k-th neighbour holds k points.
        wide = _around(standing.reached(PLANE_POINTS), standing, rows, PLANE_POINTS)
        spacing = wide * np.sqrt(np.pi / PLANE_POINTS)
        out[rows] |= in_blocks(lambda block: _off_the_plane(standing, rows[block], spacing[block]), len(rows))
    return np.flatnonzero(out)


def _lie_far_off(
    points: NDArray[np.float64], left: NDArray[np.int64], rows: NDArray[np.int64], farther: float
) -> NDArray[np.bool_]:
    """Return which of the `rows` of points (n, 3) stand out over the far reach among those `left`, (rows,) bool."""
    standing = np.ascontiguousarray(points[left])
    nearest = left[_core.nearest_neighbors(standing, np.ascontiguousarray(points[rows]), FAR_REACH + 1)[:, 1:]]
    needed = np.zeros(len(points), dtype=bool)
    needed[rows] = needed[nearest] = True
    asked = np.flatnonzero(needed)
    places = np.ascontiguousarray(points[asked])
    last = left[_core.nearest_neighbors(standing, places, FAR_REACH + 1)[:, -1]]
    reached = np.zeros(len(points))
    reached[asked] = np.linalg.norm(points[last] - places, axis=1)
    return np.asarray(reached[rows] > farther * usual(reached[nearest]))


def _around(
    distances: NDArray[np.float64], standing: Standing, rows: NDArray[np.int64], count: int
) -> NDArray[np.float64]:
    """Return what is usual (m,) of the distances (n,) of the `count` points nearest to each of the `rows` (m,)."""
    return in_blocks(lambda block: usual(distances[standing.nearest[rows[block], :count]]), len(rows))


def _show_planes(standing: Standing) -> bool:
    """Return whether points lie next to planes, most of them: noise is less than they are apart."""
    rows = rows_along(len(standing.points), SAMPLES)
    variances, _, _ = _planes(standing, rows)
    return bool(np.median(np.sqrt(variances[:, 0] / variances[:, 1])) < MOST_THICKNESS)


def _planes(
    standing: Standing, rows: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return how the points nearest to each row lie.

    That is their variances (m, 3), ascending, along which axes (m, 3, 3), and how far their middle is from the row's
    own point along the first of these, (m,).
    """
    near = standing.points[standing.nearest[rows, :PLANE_POINTS]] - standing.points[rows, None]
    variances, axes = np.linalg.eigh(covariances(near))
    # What is distinct may still be too near for squares.
    least = np.finfo(np.float64).tiny
    return np.maximum(variances, least), axes, np.einsum("nc,nc->n", near.mean(axis=1), axes[:, :, 0])


def _off_the_plane(standing: Standing, rows: NDArray[np.int64], spacing: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which of the `rows` lie off the plane of the points nearest to them, as few of these do; (rows,) bool."""
    points = standing.points
    variances, axes, below = _planes(standing, rows)
    height = abs(below)
    deviation = np.maximum(np.sqrt(variances[:, 0]), LEAST_DEVIATION * spacing)
    off: NDArray[np.bool_] = (height > OFF_THE_PLANE * spacing) & (height > OFF_THE_REST * deviation)
    chosen = np.flatnonzero(off)
    offsets = points[standing.nearest[rows[chosen]]] - points[rows[chosen], None]
    # Those nearer to the parallel plane through the point than to the plane itself.
    heights = np.einsum("nkc,nc->nk", offsets, axes[chosen, :, 0]) / below[chosen, None]
    off[chosen[(heights < 0.5).sum(axis=1) >= COMPANY]] = False
    return off
