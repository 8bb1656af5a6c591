# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals as they are had from points alone, for samples to train on what scans have."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.normals import oriented_surface


def estimated_normals(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return unit normals (n, 3) of points (n, 3), estimated and oriented as ``hdpea reconstruct`` would.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    """
    return oriented_surface(points).surface.normals
