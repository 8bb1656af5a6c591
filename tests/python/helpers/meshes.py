# SPDX-License-Identifier: GPL-3.0-or-later
"""Small closed meshes in their unit frame, and samples of them, for the tests of the dataset."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray

from hdpea.dataset.sample import Sample
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.unit_frame import UnitFrame

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]
"""Vertices (v, 3) and faces (f, 3)."""

TORUS_DIAGONAL = (2 * 2.8**2 + 0.8**2) ** 0.5
"""Of the box around the torus before it was moved into its unit frame, when its radii were 1 and 0.4."""


def sphere() -> Mesh:
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


def sample(mesh: Mesh, points: int = 2000, seed: int = 0) -> Sample:
    """Return a sample whose psi and curvatures are told apart row by row."""
    vertices, faces = mesh
    drawn = sample_surface(vertices, faces, points, seed=seed)
    on_surface, normals = drawn.points.astype(np.float32), drawn.normals.astype(np.float32)
    along = np.cross(normals, np.roll(normals, 1, axis=1) + np.float32([0.1, 0.2, 0.3]))
    numbered = np.arange(points, dtype=np.float32)[:, None]
    return Sample(
        points=on_surface,
        surface_points=on_surface,
        normals=normals,
        psi=numbered + np.arange(5, dtype=np.float32),
        curvatures=numbered + np.arange(2, dtype=np.float32),
        direction1=along / np.linalg.norm(along, axis=1, keepdims=True),
        frame=UnitFrame(np.array([1.0, 2.0, 3.0]), 10.0),
        sensors=3 * normals,
    )


def _in_unit_frame(mesh: trimesh.Trimesh) -> Mesh:
    vertices = np.array(mesh.vertices, dtype=np.float64)
    return UnitFrame.around(vertices).to_unit(vertices), np.array(mesh.faces, dtype=np.int64)
