# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas of triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def area_vectors(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the normals (f, 3) of faces (f, 3) of `vertices` (v, 3), as long as the faces' areas."""
    return area_vectors_of(vertices[faces])


def area_vectors_of(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the normals (f, 3) of triangles with corners (f, 3, 3), as long as the triangles' areas."""
    a, b, c = corners.swapaxes(0, 1)
    return np.cross(b - a, c - a) / 2


def mesh_area(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> float:
    """Return the area of a mesh."""
    return float(np.linalg.norm(area_vectors(vertices, faces), axis=1).sum())
