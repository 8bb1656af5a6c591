# SPDX-License-Identifier: GPL-3.0-or-later
"""An order of points in which those that are near each other stand near each other, in memory as well."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

FEWEST = 10_000
"""Fewer points stay in their order: they fit into the caches in any."""

GOLDEN = (5**0.5 - 1) / 2

POINTS_PER_CELL = 16
"""Points of a surface in a cell, on average. Within a cell they keep their order, so that rounding, as by another
unit or another place, hardly ever changes it."""


def spatial_order(points: NDArray[np.floating[Any]]) -> NDArray[np.int64]:
    """Return the rows of points (n, 3) along a Z-order curve (Morton 1966) through cells of their bounding box.

    The curve begins at the first point, and goes on at its beginning after its end: what begins at the first point does
    so in any order.

    Arrays in random order do not fit the caches of a processor: 250,000 points take 2.5 times as long to find their
    nearest 40 as in this order, and all that follows gathers from these.

    Examples
    --------
    >>> import numpy as np
    >>> flat = np.random.default_rng(0).random((20_000, 3)) * [1, 1, 0]
    >>> steps = [np.linalg.norm(np.diff(each, axis=0), axis=1).mean() for each in (flat, flat[spatial_order(flat)])]
    >>> bool(steps[1] < 0.1 * steps[0])
    True
    """
    if len(points) < FEWEST:
        return np.arange(len(points))
    low = points.min(axis=0)
    extent = np.maximum(points.max(axis=0) - low, np.finfo(np.float64).tiny).max()
    levels = int(np.ceil(np.log2(len(points) / POINTS_PER_CELL) / 2))
    # The middle of a symmetric shape, and points on a grid, lie on no border of cells.
    cells = ((points - low) / extent * (2**levels - 1 + GOLDEN) + GOLDEN * (1 - GOLDEN)).astype(np.int64)
    keys = np.zeros(len(points), dtype=np.int64)
    for level in range(levels):
        for axis in range(3):
            keys |= (cells[:, axis] >> level & 1) << (3 * level + axis)
    order = np.argsort(keys, kind="stable")
    return np.roll(order, -int(np.argmax(order == 0)))
