# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that are stored twice but for rounding, as at the seam of a surface that was sampled from 0 to 2 pi."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NO_DISTANCE = 1e-9
"""Distance of copies, relative to how far half of the points lie from their median.

Triangles whose height is less than 1e-10 of their edges do not count in the embedding, and nothing else links the two
sides of a seam of copies: it tears where they are less than 2e-10 of an edge apart (the core's triangle elements)."""

STEPS = 4
"""The same in steps of the coordinates, which are larger far from the origin: a few roundings make no difference."""

MOST = 1e-6
"""Most that this may be, relative to the same: where steps are coarser, points that differ are taken as they are."""


def first_copies(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the ascending rows (m,) of distinct, finite points (n, 3) that are no copies of others but for rounding.

    Of copies the least by x, y and z stays, so that the order of the points makes no difference.
    """
    apart = _no_distance(points)
    rows, groups = np.arange(len(points)), np.zeros(len(points), dtype=np.int64)
    for values in points.T:
        order = np.lexsort((values[rows], groups))
        rows, groups = rows[order], groups[order]
        starts = np.ones(len(rows), dtype=bool)
        starts[1:] = (np.diff(groups) > 0) | (np.diff(values[rows]) > apart)
        # Most points are alone in their group after x: only the others need be looked at any further.
        alone = starts & np.append(starts[1:], True)
        rows, groups = rows[~alone], np.cumsum(starts)[~alone]
    if not len(rows):
        return np.arange(len(points))
    order = np.lexsort((*points[rows].T[::-1], groups))
    rows, groups = rows[order], groups[order]
    kept = np.ones(len(points), dtype=bool)
    kept[rows[1:][np.diff(groups) == 0]] = False
    return np.flatnonzero(kept)


def _no_distance(points: NDArray[np.float64]) -> float:
    """Return the difference of coordinates up to which points (n, 3) are copies.

    Medians tell: one stray that lies far away is not to make copies of all others.
    """
    extent = float(np.median(abs(points - np.median(points, axis=0)).max(axis=1)))
    step = float(np.spacing(np.median(abs(points).max(axis=1))))
    return max(NO_DISTANCE * extent, min(STEPS * step, MOST * extent))
