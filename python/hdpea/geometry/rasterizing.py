# SPDX-License-Identifier: GPL-3.0-or-later
"""Which pixels lie in which triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class CoveredPixels:
    """The pixels whose centres lie in triangles.

    Attributes
    ----------
    pixels
        (m,) int64, ascending: row * width + column.
    triangles
        (m,) int64, in which of the triangles each lies: the first, if in several.
    barycentric
        (m, 3) float64: where in it.
    """

    pixels: NDArray[np.int64]
    triangles: NDArray[np.int64]
    barycentric: NDArray[np.float64]


def covered_pixels(triangles: NDArray[np.float64], height: int, width: int) -> CoveredPixels:
    """Return the pixels of an image in triangles (t, 3, 2) of columns and rows; pixel i extends from i to i + 1."""
    pixels, owners, weights = [np.empty(0, np.int64)], [np.empty(0, np.int64)], [np.empty((0, 3))]
    centred = triangles - 0.5  # the centres of the pixels are whole numbers
    lowest = np.ceil(centred.min(axis=1)).clip(0).astype(np.int64)
    highest = np.floor(centred.max(axis=1)).clip(max=[width - 1, height - 1]).astype(np.int64)
    for triangle in np.flatnonzero((lowest <= highest).all(axis=1)):
        (x, y), (left, top), (right, bottom) = centred[triangle].T, lowest[triangle], highest[triangle]
        columns, rows = np.arange(left, right + 1), np.arange(top, bottom + 1)[:, None]
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        if area == 0:
            continue
        second = ((columns - x[0]) * (y[2] - y[0]) - (rows - y[0]) * (x[2] - x[0])) / area
        third = ((rows - y[0]) * (x[1] - x[0]) - (columns - x[0]) * (y[1] - y[0])) / area
        inside = (second >= 0) & (third >= 0) & (second + third <= 1)
        pixels.append((rows * width + columns)[inside])
        owners.append(np.full(len(pixels[-1]), triangle))
        weights.append(np.stack([1 - second - third, second, third], axis=-1)[inside])
    found, first = np.unique(np.concatenate(pixels), return_index=True)
    return CoveredPixels(found, np.concatenate(owners)[first], np.concatenate(weights)[first])
