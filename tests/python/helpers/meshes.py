# SPDX-License-Identifier: GPL-3.0-or-later
"""Small closed meshes: a tetrahedron, and others in their unit frame."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from hdpea.geometry.unit_frame import UnitFrame

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]
"""Vertices (v, 3) and faces (f, 3)."""

TORUS_DIAGONAL = (2 * 2.8**2 + 0.8**2) ** 0.5
"""Of the box around the torus before it was moved into its unit frame, when its radii were 1 and 0.4."""


TETRAHEDRON_FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def tetrahedron(center: float = 0.0, size: float = 1.0) -> NDArray[np.float64]:
    """Return the four corners (4, 3) of a right-angled tetrahedron, to go with ``TETRAHEDRON_FACES``."""
    return center + size * np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])


def icosphere() -> Mesh:
    return _in_unit_frame(trimesh.creation.icosphere(subdivisions=3))


def torus() -> Mesh:
    return _in_unit_frame(trimesh.creation.torus(1.0, 0.4, 48, 24))


def box() -> Mesh:
    return _in_unit_frame(trimesh.creation.box((3, 2, 1)))


def nested_spheres() -> Mesh:
    """Return a sphere with a closed cavity, whose faces come last, as many as those outside."""
    outer, inner = trimesh.creation.icosphere(subdivisions=3), trimesh.creation.icosphere(subdivisions=3, radius=0.8)
    inner.invert()
    return _in_unit_frame(trimesh.util.concatenate([outer, inner]))


def _in_unit_frame(mesh: trimesh.Trimesh) -> Mesh:
    vertices = np.array(mesh.vertices, dtype=np.float64)
    return UnitFrame.around(vertices).to_unit(vertices), np.array(mesh.faces, dtype=np.int64)
