# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions: points of the unit sphere."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

TAU = 2 * np.pi
GOLDEN_ANGLE = TAU * (2 - (1 + 5**0.5) / 2)


def directions_of(vectors: NDArray[np.float64], otherwise: ArrayLike = 0.0) -> NDArray[np.float64]:
    """Return the vectors (n, 3) at length 1; where they have none, what stands there `otherwise`."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(lengths == 0, otherwise, vectors / np.where(lengths > 0, lengths, 1))


def on_sphere(azimuth: NDArray[np.float64], height: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the points (n, 3) of the unit sphere of these azimuths (n,), in radians, and heights (n,), -1 to 1."""
    radius = np.sqrt(1 - height**2)
    return np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), height], axis=1)


def fibonacci_spiral(count: int, coverage: float = 1.0) -> NDArray[np.float64]:
    """Return evenly spread points (count, 3) of the unit sphere, or of its cap around z with that share of its area."""
    each = np.arange(count)
    height: NDArray[np.float64] = 1 - 2 * coverage * (each + 0.5) / count
    return on_sphere(GOLDEN_ANGLE * each.astype(np.float64), height)
