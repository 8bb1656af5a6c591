# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples whose truth is known in closed form, or whose rows can be told apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from helpers.clouds import sphere_points
from helpers.meshes import Mesh

from hdpea.dataset.sample import Sample
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.unit_frame import UnitFrame


def sphere_sample(count: int = 50, noise: float = 0.0, scanned: bool = False) -> Sample:
    """A sphere around (1, 2, 3), whose bounding-box diagonal is 7; psi is that of its normal, as on any surface."""
    normals = sphere_points(count)
    radius = 1 / np.sqrt(12)
    direction1 = np.cross(normals, [0.0, 0.0, 1.0]) + 1e-9
    direction1 /= np.linalg.norm(direction1, axis=1, keepdims=True)
    sample = Sample(
        points=np.float32(radius * normals * (1 + noise)),
        surface_points=np.float32(radius * normals),
        normals=np.float32(normals),
        psi=np.float32(np.pad(normals, ((0, 0), (0, 2)))),
        curvatures=np.full((count, 2), 1 / radius, np.float32),
        direction1=np.float32(direction1),
        frame=UnitFrame(np.array([1.0, 2.0, 3.0]), 7.0),
    )
    sensors = np.tile(np.float32([0, 0, 2]), (count, 1))
    return replace(sample, sensors=sensors, estimated_normals=np.float32(normals)) if scanned else sample


def numbered_sample(mesh: Mesh, points: int = 2000, seed: int = 0) -> Sample:
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
