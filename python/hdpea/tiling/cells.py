# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a cloud has its points, by the cells of a grid: all that is in memory of it while tiles are cut."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

LEVELS = 10
"""The grid has 2^10 cells along the longest side of the unit frame's box."""

POINTS_PER_CELL = 16
"""Cells are joined, eight to one, until so many points lie in one on average: emptier ones tell nothing of an area."""

CUT = 1.5
"""Cells of width 1 that a surface of area 1 runs through, averaged over its directions: the mean of the sums of the
coordinates of unit vectors (Cauchy)."""


@dataclass(frozen=True)
class Cells:
    """The cells of a grid that hold points.

    Attributes
    ----------
    width
        Of a cell, in the unit frame.
    indices
        (c, 3) int64: place of each cell in the grid, whose corner is at -1/2 of each coordinate.
    counts
        (c,) int64: points in each.
    """

    width: float
    indices: NDArray[np.int64]
    counts: NDArray[np.int64]

    @classmethod
    def of(cls, chunks: Iterable[NDArray[np.float64]]) -> Cells:
        """Count points in the unit frame, given piece by piece."""
        keys, counts = np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
        for points in chunks:
            found = np.concatenate([keys, _keys(cell_indices(points, 2.0**-LEVELS))])
            weights = np.concatenate([counts, np.ones(len(points), dtype=np.int64)])
            keys, inverse = np.unique(found, return_inverse=True)
            counts = np.bincount(inverse, weights).astype(np.int64)
        cells = cls(2.0**-LEVELS, np.stack([keys >> 40, keys >> 20 & 0xFFFFF, keys & 0xFFFFF], axis=1), counts)
        while len(cells.counts) > 1 and cells.counts.mean() < POINTS_PER_CELL:
            cells = cells.joined()
        return cells

    def joined(self) -> Cells:
        """Return the cells of a grid twice as wide."""
        keys, inverse = np.unique(_keys(self.indices >> 1), return_inverse=True)
        indices = np.stack([keys >> 40, keys >> 20 & 0xFFFFF, keys & 0xFFFFF], axis=1)
        return Cells(2 * self.width, indices, np.bincount(inverse, self.counts).astype(np.int64))

    def area(self) -> float:
        """Return the area of the surface that runs through the cells, roughly."""
        return len(self.counts) * self.width**2 / CUT

    def in_box(self, low: NDArray[np.float64], high: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Return which cells (c,) reach into a box."""
        least = self.indices * self.width - 0.5
        return np.asarray(((least < high) & (least + self.width > low)).all(axis=1))

    def points_in(self, low: NDArray[np.float64], high: NDArray[np.float64]) -> int:
        """Return how many points the cells that reach into a box have."""
        return int(self.counts[self.in_box(low, high)].sum())

    def middle_of(self, low: NDArray[np.float64], high: NDArray[np.float64]) -> tuple[int, float]:
        """Return the axis along which the cells in a box extend most, and where to cut them into equal halves."""
        inside = self.in_box(low, high)
        indices, counts = self.indices[inside], self.counts[inside]
        axis = int(np.argmax(np.ptp(indices, axis=0)))
        along = np.bincount(indices[:, axis] - indices[:, axis].min(), counts).cumsum()
        before = min(int(np.argmin(np.abs(along - along[-1] / 2))), len(along) - 2)
        return axis, float((indices[:, axis].min() + max(before, 0) + 1) * self.width - 0.5)


def cell_indices(points: NDArray[np.float64], width: float) -> NDArray[np.int64]:
    """Return the cell (n, 3) of each point (n, 3) of the unit frame."""
    return np.floor((points + 0.5) / width).astype(np.int64)


def _keys(indices: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.asarray(indices[:, 0] << 40 | indices[:, 1] << 20 | indices[:, 2])


def rows_of(cells: Cells, points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the row among the cells (n,) of each point (n, 3), which they were counted from."""
    return np.searchsorted(_keys(cells.indices), _keys(cell_indices(points, cells.width)))
