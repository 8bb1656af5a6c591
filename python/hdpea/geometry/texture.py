# SPDX-License-Identifier: GPL-3.0-or-later
"""An image that is laid on a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Texture:
    """An image, and where in it each face lies.

    Attributes
    ----------
    image
        (s, s, 3) uint8, sRGB, the top row first.
    places
        (t, 2) float64 from 0 to 1: across, and down from the top.
    corners
        (f, 3) int64: the places of the corners of each face. A vertex on a seam has several.
    vertices
        (t,) int64: the vertex at each place.
    """

    image: NDArray[np.uint8]
    places: NDArray[np.float64]
    corners: NDArray[np.int64]
    vertices: NDArray[np.int64]
