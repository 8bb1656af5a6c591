# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours as files hold them (sRGB) and as light adds up (linear); IEC 61966-2-1."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

RGB = ("red", "green", "blue")
"""How files name the parts of a colour."""


def linear_of_srgb(color: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return linear light, 0 to 1, of sRGB values, 0 to 1."""
    return np.where(color <= 0.04045, color / 12.92, ((color + 0.055) / 1.055) ** 2.4)


def srgb_of_linear(light: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return sRGB values, 0 to 1, of linear light, 0 to 1."""
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
