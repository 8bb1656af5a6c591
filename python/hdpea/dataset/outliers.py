# SPDX-License-Identifier: GPL-3.0-or-later
"""Outliers: points that stray anywhere in a box around the others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated

OUTLIER_BOX = 1.2
"""Size of the box in which outliers lie, relative to the bounding box of the points."""


@dataclass(frozen=True)
class Outliers:
    """The points that stray.

    Attributes
    ----------
    rows
        (k,) int64: which of the points they are.
    places
        (k, 3) float64: where they are moved to.
    nearest
        (k,) int64: of all points of the surface, the one nearest to each; its truth is that of the outlier.
    """

    rows: NDArray[np.int64]
    places: NDArray[np.float64]
    nearest: NDArray[np.int64]


def draw_outliers(
    points: NDArray[Any], surface_points: NDArray[Any], share: float, rng: np.random.Generator
) -> Outliers:
    """Choose a share of `points` (n, 3), which stand for `surface_points` (n, 3), and random places for them."""
    rows = rng.choice(len(points), round(share * len(points)), replace=False)
    lowest, highest = points.min(axis=0), points.max(axis=0)
    places = (lowest + highest) / 2 + OUTLIER_BOX * (highest - lowest) * (rng.random((len(rows), 3)) - 0.5)
    with core_errors_translated():
        nearest = _core.nearest_neighbors(surface_points.astype(np.float64), places.astype(np.float64), 1)[:, 0]
    return Outliers(rows, places, nearest)
