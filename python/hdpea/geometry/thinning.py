# SPDX-License-Identifier: GPL-3.0-or-later
"""Subsets of clouds: at random, along their rows, far from each other, or without some."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core


def thinned(count: int, most: int) -> NDArray[np.int64]:
    """Return rows, ascending: all of `count`, or `most` of them at random, always the same."""
    if count <= most:
        return np.arange(count)
    return np.sort(np.random.default_rng(0).permutation(count)[:most])


def rows_along(count: int, most: int) -> NDArray[np.int64]:
    """Return `most` of `count` rows, from the first to the last and evenly between them; all, if there are no more."""
    return np.linspace(0, count - 1, min(most, count)).astype(np.int64)


def rows_without(count: int, *left_out: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return rows, ascending: those of `count` that are in none of the arrays `left_out`.

    As `np.setdiff1d` does, whose sorting takes seconds of a million rows.
    """
    kept = np.ones(count, dtype=bool)
    for rows in left_out:
        kept[rows] = False
    return np.flatnonzero(kept)


def farthest_rows(points: NDArray[np.float64], count: int) -> NDArray[np.int64]:
    """Return the rows (count,) of the points (n, 3) that lie farthest from each other, in the order they are taken.

    From the point farthest out, whichever row that is.
    """
    first = int(np.argmax(np.square(points - points.mean(axis=0)).sum(axis=1)))
    return _core.farthest_point_sampling(points, count, [first])
