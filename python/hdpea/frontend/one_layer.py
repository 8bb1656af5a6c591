# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether noise as wide as points are apart is that of one layer, or hides the two sides of a plate."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.frontend.patches import QUADRIC, Patches
from hdpea.geometry.thinning import rows_along

PATCH, LEAST_KURTOSIS = 200, 2.86
"""Nearest points whose heights over a quadric are looked at, and their least kurtosis, of the median patch, in a layer.

Of flat and hilly ground with normal noise of 0.3 to 2 spacings it is 2.89 to 3.0; of plates 1 to 4 spacings thick with
noise of 0.3 to 1, 1.4 to 2.82: two layers are flatter than one."""

SAMPLES, FEWEST = 500, 10
"""How many patches are looked at, and the fewest that must have room beside each other: fewer show the shape."""


def are_of_one_layer(points: NDArray[np.float64]) -> bool:
    """Tell whether points (n, 3) with wide noise lie about one layer; of few it cannot be told, and is not so."""
    if len(points) < FEWEST * PATCH:
        return False
    heights = Patches.around(points, rows_along(len(points), SAMPLES), PATCH).residuals(QUADRIC)
    squares = np.square(heights)
    kurtosis = np.square(squares).mean(axis=1) / np.maximum(np.square(squares.mean(axis=1)), np.finfo(np.float64).tiny)
    return bool(np.median(kurtosis) >= LEAST_KURTOSIS)
