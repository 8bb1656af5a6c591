# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples whose truth is known in closed form."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from helpers.shapes import sphere

from hdpea.dataset.sample import Sample
from hdpea.geometry.unit_frame import UnitFrame


def sphere_sample(count: int = 50, noise: float = 0.0, scanned: bool = False) -> Sample:
    """A sphere around (1, 2, 3), whose bounding-box diagonal is 7; psi is that of its normal, as on any surface."""
    normals = sphere(count)
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
