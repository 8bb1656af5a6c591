# SPDX-License-Identifier: GPL-3.0-or-later
"""Tangent planes of the embedded surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.options.meshing import POINTS_PER_VERTEX

TANGENT_NEIGHBORS = 12
"""Neighbours that a tangent plane is fitted to (HD-PEA paper, section 3.2), for ``POINTS_PER_VERTEX`` and fewer."""

PER_VERTEX = 1.5
"""Neighbours per point per vertex, where there are more: noise of a redundant cloud is averaged out."""


def tangent_bases(
    coordinates: NDArray[np.float64],
    normals: NDArray[np.float64],
    neighbors: NDArray[np.int64],
    points_per_vertex: float = POINTS_PER_VERTEX,
) -> NDArray[np.float64]:
    """Return an orthonormal basis (n, 2, d) of the tangent plane at each embedded point.

    The plane across the normal, and on it an affine fit of the extra coordinates. The HD-PEA paper (section 3.2) uses
    PCA in R^d, which does not take the normal into account and fails on thin parts.

    Parameters
    ----------
    coordinates
        (n, d) float64, the first three the positions.
    normals
        (n, 3) float64, unit.
    neighbors
        (n, k) int64: neighbours *in R^3*, of the same sheet, padded with -1. Neighbours in R^d would jump between folds
        (HD-PEA paper, section 4.3).
    points_per_vertex
        Points for each vertex that would show what they do (``hdpea.options.Options.resolution_of``): with more, planes
        are fitted to more neighbours.
    """
    count = max(TANGENT_NEIGHBORS, round(PER_VERTEX * points_per_vertex))
    nearest = np.ascontiguousarray(neighbors[:, :count])
    with core_errors_translated():
        return _core.tangent_bases(coordinates, normals, nearest).reshape(len(coordinates), 2, -1)
