# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals estimated from the points alone, so that samples have normals like those of scans."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.options import NormalOptions
from hdpea.surface.normals import oriented_surface

ORIENTATION = NormalOptions(orient="wnnc")
"""By winding number, which suits closed surfaces and is robust to noise (as in the HD-PEA paper, section 4.1)."""


def estimated_normals(points: NDArray[np.floating[Any]]) -> NDArray[np.float32]:
    """Return unit normals (n, 3) float32 of points (n, 3), estimated and oriented by the winding number.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    """
    return oriented_surface(points.astype(np.float64), options=ORIENTATION).surface.normals.astype(np.float32)
