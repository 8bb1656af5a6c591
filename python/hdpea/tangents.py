# SPDX-License-Identifier: GPL-3.0-or-later
"""Tangent planes of the embedded surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated

TANGENT_NEIGHBORS = 12
"""Neighbours whose plane is the tangent plane (paper, section 3.2)."""


def tangent_bases(coordinates: NDArray[np.float64], neighbors: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return an orthonormal basis (n, 2, d) of the tangent plane at each embedded point.

    PCA of the embedded neighbours, the top two eigenvectors (paper, section 3.2).

    Parameters
    ----------
    coordinates
        (n, d) float64.
    neighbors
        (n, k >= 12) int64: neighbours *in R^3*, of the same sheet, padded with -1. Neighbours in R^d
        would jump between folds (the paper's ablation).
    """
    nearest = np.ascontiguousarray(neighbors[:, :TANGENT_NEIGHBORS])
    with core_errors_translated():
        return _core.tangent_bases(coordinates, nearest).reshape(len(coordinates), 2, -1)
