# SPDX-License-Identifier: GPL-3.0-or-later
"""The points of a cloud that still stand while others are dropped, and how far apart those near each other are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

FARTHER = 2.0
"""How many times farther from its neighbours than these from theirs a stray is: of 40,000 points spread at random over
a surface none comes to it."""

SURROUNDINGS = 0.25
"""Quantile of the neighbours' distances that it is compared with: a quarter of them may tell, the others be strays."""


class Standing:
    """Points of which some are dropped, and the nearest that are left of each: only those that change are looked up.

    Attributes
    ----------
    points
        (n, 3) float64, all of them.
    left
        (n,) bool: which are not dropped.
    nearest
        (n, k) int64: rows of the nearest other points, where the point itself is left.
    """

    def __init__(self, points: NDArray[np.float64], nearest: NDArray[np.int64]) -> None:
        self.points = points
        self.left = np.ones(len(points), dtype=bool)
        self.nearest = nearest.copy()

    @property
    def rows(self) -> NDArray[np.int64]:
        """The rows (m,) of the points that are left."""
        return np.flatnonzero(self.left)

    def drop(self, rows: NDArray[np.int64]) -> NDArray[np.int64]:
        """Drop points, and return the rows of those left among whose nearest, or the nearest of these, one was."""
        self.left[rows] = False
        left = self.rows
        renewed = left[~self.left[self.nearest[left]].all(axis=1)]
        standing = np.ascontiguousarray(self.points[left])
        # The nearest to a point that is left is the point itself.
        found = _core.nearest_neighbors(standing, np.ascontiguousarray(self.points[renewed]), self.nearest.shape[1] + 1)
        self.nearest[renewed] = left[found[:, 1:]]
        touched = np.zeros(len(self.points), dtype=bool)
        touched[renewed] = True
        return left[touched[left] | touched[self.nearest[left]].any(axis=1)]

    def reached(self, count: int) -> NDArray[np.float64]:
        """Return how far each point's `count`-th nearest is away, (n,): of those that are left."""
        offsets = self.points[self.nearest[:, count - 1]] - self.points
        return np.asarray(np.sqrt(np.einsum("nc,nc->n", offsets, offsets)))


def usual(distances: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what is usual (m,) of the distances (m, k) of neighbours, whether strays are among these or not."""
    return np.asarray(np.quantile(distances, SURROUNDINGS, axis=1))
