# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours that mean the same in every picture."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Colors = NDArray[np.uint8]

MOST_ANISOTROPIC = 4.0
"""Ratio of the stretches from which the colour is red, where pictures are to be compared."""

RAMP = ((0.23, 0.30, 0.75), (0.87, 0.87, 0.87), (0.71, 0.02, 0.15))
"""Red, green and blue at ratio 1, at the square root of the largest, and there."""

UNDETERMINED = (0.42, 0.42, 0.42)
"""Red, green and blue of what is not known: darker than the middle of the ramp."""


def ratio_colors(ratio: NDArray[np.float64], most: float = MOST_ANISOTROPIC) -> Colors:
    """Return ratios of stretches (n,) as colours (n, 3): blue where 1, over grey to red where `most`."""
    share = (np.log(ratio) / np.log(most)).clip(0, 1)
    anchors = np.array(RAMP)
    return as_bytes(np.column_stack([np.interp(share, [0, 0.5, 1], anchors[:, channel]) for channel in range(3)]))


def as_bytes(shares: NDArray[Any]) -> Colors:
    """Return shares of the full intensity, of any shape, as numbers from 0 to 255."""
    colors: Colors = np.rint(255 * shares.clip(0, 1)).astype(np.uint8)
    return colors
