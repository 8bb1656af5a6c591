# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas, normals and neighbours of triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TriangleMesh = tuple[NDArray[np.float64], NDArray[np.int64]]
"""Vertices (v, 3) and faces (f, 3)."""


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


def circumradii(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the radii (f,) of the circles through the corners (f, 3, d) of triangles in R^d; infinite without area."""
    a, b, c = (np.linalg.norm(corners[:, (i + 1) % 3] - corners[:, (i + 2) % 3], axis=1) for i in range(3))
    squared = (a + b + c) * (b + c - a) * (c + a - b) * (a + b - c)  # of four times the area
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(squared > 0, a * b * c / np.sqrt(squared), np.inf)


def vertex_normals(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return unit normals (v, 3) at the vertices; z where there are no faces, or they cancel out.

    Faces count by their angle at the vertex (Thürmer and Wüthrich 1998), so that it does not matter how a flat
    neighbourhood is cut into triangles.
    """
    corners = vertices[faces]
    with np.errstate(invalid="ignore", divide="ignore"):
        normals = _unit(area_vectors_of(corners))
        sums = np.zeros_like(vertices)
        for i in range(3):
            to_next, to_previous = (
                _unit(corners[:, (i + 1) % 3] - corners[:, i]),
                _unit(corners[:, i - 1] - corners[:, i]),
            )
            angles = np.arccos(np.einsum("fc,fc->f", to_next, to_previous).clip(-1, 1))
            np.add.at(sums, faces[:, i], np.nan_to_num(angles[:, None] * normals))
        normals = _unit(sums)
    return np.where(np.isfinite(normals).all(axis=1, keepdims=True), normals, [0.0, 0.0, 1.0])


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


def opposite_faces(faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the face (f, 3) beyond each edge of oriented faces (f, 3): from corner to corner; -1 where none is."""
    starts, ends = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    count = int(faces.max(initial=0)) + 1
    keys, back = starts * count + ends, ends * count + starts
    order = np.argsort(keys)
    at = order[np.searchsorted(keys[order], back).clip(max=len(keys) - 1)]
    return np.where(keys[at] == back, at // 3, -1).reshape(-1, 3)
