# SPDX-License-Identifier: GPL-3.0-or-later
"""Tiny named shapes for the tests."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TETRAHEDRON_FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def sphere(count: int, seed: int = 0) -> NDArray[np.float64]:
    """Return (count, 3) points on the unit sphere; they are their own normals."""
    points = np.random.default_rng(seed).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def tetrahedron(center: float = 0.0, size: float = 1.0) -> NDArray[np.float64]:
    """Return the four corners (4, 3) of a right-angled tetrahedron, to go with ``TETRAHEDRON_FACES``."""
    return center + size * np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
