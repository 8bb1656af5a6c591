# SPDX-License-Identifier: GPL-3.0-or-later
"""How noisy a cloud is, told from the points alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

SAMPLES = 2_000
"""Points looked at: their median is sure to a few percent."""

NEIGHBORS = 24
"""Points that a quadratic surface, of six unknowns, is fitted to."""

CLEANEST = 0.25
"""Share of the points whose residual is below the one reported: creases are not noise, for they are not everywhere."""


def noise_in_spacings(points: NDArray[np.float64]) -> float:
    """Return the standard deviation of points (n, 3) across their surface, in spacings of the points; 0 for under 24.

    It is what quadratic surfaces leave over, so that curvature does not count as noise; and the spacing is the side of
    the square of surface that each point has for itself.
    """
    count = len(points)
    if count < NEIGHBORS:
        return 0.0
    rows = np.linspace(0, count - 1, min(SAMPLES, count)).astype(np.int64)
    around = points[_core.nearest_neighbors(points, points[rows], NEIGHBORS)]
    ways = around - around.mean(axis=1, keepdims=True)
    radii = np.linalg.norm(around - points[rows, None], axis=2).max(axis=1)
    _, frames = np.linalg.eigh(ways.swapaxes(1, 2) @ ways)
    height, u, v = np.moveaxis((ways @ frames) / radii[:, None, None], 2, 0)
    design = np.stack([np.ones_like(u), u, v, u * u, u * v, v * v], axis=2)
    # Projected by the pseudo-inverse: neighbours on a line leave the surface open, and nothing over.
    left = height - (design @ (np.linalg.pinv(design) @ height[:, :, None]))[:, :, 0]
    deviations = np.sqrt(np.square(left).sum(axis=1) / (NEIGHBORS - design.shape[2]))
    return float(np.quantile(deviations * np.sqrt(NEIGHBORS / np.pi), CLEANEST))
