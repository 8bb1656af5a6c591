# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances from points to triangles, by measuring every pair."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def to_triangles(points: Array, corners: Array) -> Array:
    """Return the distance (n,) of each point (n, 3) to the nearest of triangles (f, 3, 3); units of the order of 1."""
    return np.array([_to_each(point, corners).min() for point in points])


def _to_each(point: Array, corners: Array) -> Array:
    starts, ends = corners, np.roll(corners, -1, axis=1)
    to_border = _to_segments(point, starts, ends).min(axis=1)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    # Above the triangle if it is on the inner side of each of its edges.
    sides = np.einsum("fei,fi->fe", np.cross(ends - starts, point - starts), normals)
    lengths = np.linalg.norm(normals, axis=1)
    above = (sides >= 0).all(axis=1) & (lengths > 0)
    to_plane = abs(np.einsum("fi,fi->f", point - corners[:, 0], normals)) / np.where(above, lengths, 1)
    return np.where(above, np.minimum(to_plane, to_border), to_border)


def _to_segments(point: Array, starts: Array, ends: Array) -> Array:
    along = ends - starts
    squared = (along**2).sum(axis=-1)
    shares = ((point - starts) * along).sum(axis=-1) / np.where(squared > 0, squared, 1)
    return np.linalg.norm(point - (starts + shares.clip(0, 1)[..., None] * along), axis=-1)
