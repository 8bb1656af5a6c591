# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands for a crowd of points: their mean, which has less noise than any of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core


def crowd_means(points: NDArray[np.float64], kept: NDArray[np.bool_], strays: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return for each kept one of points (n, 3) the mean (k, 3) of those that it stands for: no others are nearer.

    Strays, (n,) bool, are no part of any crowd.
    """
    origin = np.median(points, axis=0)
    # Differences of large coordinates lose digits, so the origin comes to the cloud first.
    standing, crowd = (np.ascontiguousarray(points[rows] - origin) for rows in (kept, ~strays))
    nearest = _core.nearest_neighbors(standing, crowd, 1)[:, 0]
    sums = np.stack([np.bincount(nearest, each, len(standing)) for each in crowd.T], axis=1)
    return np.asarray(origin + sums / np.bincount(nearest, minlength=len(standing))[:, None])
