# SPDX-License-Identifier: GPL-3.0-or-later
"""How a triangle mesh bends at its vertices, and how long its triangles are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.directions import directions_of
from hdpea.geometry.triangles import area_vectors

Rows = NDArray[np.float64]


def vertex_means(values: Rows, faces: NDArray[np.int64], weights: Rows, count: int) -> Rows:
    """Return the means (count,) at vertices of `values` (f,) on their faces, by `weights` (f,); NaN without a face."""
    corners = faces.ravel()
    totals = np.bincount(corners, np.repeat(weights * values, 3), count)
    shares = np.bincount(corners, np.repeat(weights, 3), count)
    return np.asarray(np.divide(totals, shares, out=np.full(count, np.nan), where=shares > 0))


def largest_curvatures(vertices: Rows, faces: NDArray[np.int64]) -> Rows:
    """Return at each vertex the principal curvature of largest magnitude, in 1 / length, positive where convex (v,).

    On each face the shape operator is fitted to the change of the vertices' normals along its edges (Rusinkiewicz,
    "Estimating curvatures and their derivatives on triangle meshes", 3DPVT 2004); vertices have the mean of their
    faces, by area. NaN without a face.

    Parameters
    ----------
    vertices, faces
        (v, 3) float64 and (f, 3) int64, outward.
    """
    size = float(np.ptp(vertices, axis=0).max(initial=0)) or 1.0
    vertices = vertices / size
    across = area_vectors(vertices, faces)
    normals = _vertex_normals(vertices, faces)
    corners, around = vertices[faces], normals[faces]
    edges, changes = (np.roll(each, -1, axis=1) - each for each in (corners, around))
    u = directions_of(edges[:, 0])
    plane = np.stack([u, np.cross(directions_of(across), u)], axis=2)
    (x, y), (changed_x, changed_y) = (np.moveaxis(each @ plane, 2, 0) for each in (edges, changes))
    # The operator [[a, b], [b, c]] takes an edge (x, y) to its change: six equations for (a, b, c).
    zero = np.zeros_like(x)
    equations = np.concatenate([np.stack([x, y, zero], axis=2), np.stack([zero, x, y], axis=2)], axis=1)
    wanted = np.concatenate([changed_x, changed_y], axis=1)
    normal_matrix = np.einsum("fei,fej->fij", equations, equations)
    normal_matrix += 1e-9 * np.trace(normal_matrix, axis1=1, axis2=2)[:, None, None] * np.eye(3) + 1e-300 * np.eye(3)
    a, b, c = np.linalg.solve(normal_matrix, np.einsum("fei,fe->fi", equations, wanted)[:, :, None])[:, :, 0].T
    mean, half = (a + c) / 2, np.hypot((a - c) / 2, b)
    largest = np.where(mean >= 0, mean + half, mean - half)
    return vertex_means(largest, faces, np.linalg.norm(across, axis=1), len(vertices)) / size


def triangle_stretches(vertices: Rows, faces: NDArray[np.int64]) -> Rows:
    """Return how many times longer than wide the triangles are, against equilateral ones (f,): 1 or more.

    The ratio r of the singular values of the map from an equilateral triangle: r + 1 / r is the sum of the squared
    edges over 2 sqrt(3) times the area. Infinite without an area.
    """
    corners = vertices[faces]
    squares = ((np.roll(corners, -1, axis=1) - corners) ** 2).sum(axis=(1, 2))
    areas = np.linalg.norm(area_vectors(vertices, faces), axis=1)
    total = np.divide(squares, 2 * np.sqrt(3) * areas, out=np.full(len(faces), np.inf), where=areas > 0).clip(min=2)
    return np.asarray((total + np.sqrt(total**2 - 4)) / 2)


def _vertex_normals(vertices: Rows, faces: NDArray[np.int64]) -> Rows:
    """Return unit normals (v, 3), exact on a sphere (Max, "Weights for computing vertex normals", 1999)."""
    corners = vertices[faces]
    onward, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    squares = (onward**2).sum(axis=2) * (back**2).sum(axis=2)
    weighted = np.cross(onward, back) / np.where(squares > 0, squares, 1)[:, :, None]
    totals = [np.bincount(faces.ravel(), weighted[:, :, axis].ravel(), len(vertices)) for axis in range(3)]
    return directions_of(np.column_stack(totals))
