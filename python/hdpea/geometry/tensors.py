# SPDX-License-Identifier: GPL-3.0-or-later
"""Symmetric tensors of a surface: from principal values and directions, and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

Rows = NDArray[np.float64]


def symmetric_tensors(values: Rows, directions: Rows) -> Rows:
    """Return the tensors (n, d, d) that are the sums of values (n, k) times d d^T of directions (n, k, d)."""
    return np.asarray(np.einsum("nk,nki,nkj->nij", values, directions, directions))


def tangent_directions(normals: Rows, direction1: Rows) -> Rows:
    """Return unit tangents (n, 2, 3): direction1 (n, 3), and the normals (n, 3) times it (cross product)."""
    return np.stack([direction1, np.cross(normals, direction1)], axis=1)


def frames(normals: Rows, direction1: Rows) -> Rows:
    """Return right-handed orthonormal frames (n, 3, 3): both tangent directions, then the normal."""
    return np.concatenate([tangent_directions(normals, direction1), normals[:, None]], axis=1)


def metric_tensors(normals: Rows, direction1: Rows, stretches: Rows) -> Rows:
    """Return the tensors (n, 3, 3) of unit vectors (n, 3) and stretches (n, 2); the identity along the normals."""
    squares = np.column_stack([stretches**2, np.ones(len(stretches))])
    return symmetric_tensors(squares, frames(normals, direction1))


def principal(tensors: Rows) -> tuple[Rows, Rows]:
    """Return the principal values and the first direction of symmetric tensors (n, 3, 3) that are 0 along the normals.

    Returns
    -------
    The two values of largest magnitude (n, 2), the larger first, and the unit direction (n, 3) of the first.
    """
    values, vectors = np.linalg.eigh(tensors)
    order = np.argsort(-np.abs(values), axis=1, kind="stable")
    direction1 = np.take_along_axis(vectors, order[:, None, :1], axis=2)[:, :, 0]
    return np.take_along_axis(values, order[:, :2], axis=1), direction1


def principal_in_planes(tensors: Rows, normals: Rows) -> tuple[Rows, Rows]:
    """Return the principal values and the first direction of tensors (n, 3, 3) within the planes across normals (n, 3).

    Returns
    -------
    As ``principal``.
    """
    bases = _core.tangent_bases_across(normals).reshape(-1, 2, 3)
    inside = bases @ tensors @ bases.swapaxes(1, 2)
    middle, half = (inside[:, 0, 0] + inside[:, 1, 1]) / 2, (inside[:, 0, 0] - inside[:, 1, 1]) / 2
    radius = np.hypot(half, inside[:, 0, 1])  # of Mohr's circle
    sign = np.where(middle < 0, -1, 1)
    angle = (np.arctan2(inside[:, 0, 1], half) + np.where(middle < 0, np.pi, 0)) / 2
    direction1 = np.cos(angle)[:, None] * bases[:, 0] + np.sin(angle)[:, None] * bases[:, 1]
    return np.stack([middle + sign * radius, middle - sign * radius], axis=1), direction1
