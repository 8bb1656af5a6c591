# SPDX-License-Identifier: GPL-3.0-or-later
"""Which way is up on a surface that nobody has seen before."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.triangles import area_vectors
from hdpea.options.upright import UP_AXES

Vector = NDArray[np.float64]

AXES: dict[str, Vector] = dict(zip(UP_AXES, np.array([[0.0, 0, 1], [0, 1, 0], [0, -1, 0]]), strict=True))
"""The axes by name."""

GLTF_FROM_WORLD: dict[str, NDArray[np.float64]] = {
    "z": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]),
    "y": np.eye(3),
    "-y": np.diag([1.0, -1.0, -1.0]),
}
"""Rotations (3, 3) into glTF, which has y up and x to the right, by what is up in the world."""

OPEN = 0.15
"""Length of the mean unit normal from which a surface counts as open: a closed one has 0, a plane 1. Scans of whole
objects without their undersides have up to 0.12, single views from 0.3 on."""

RESTING = 3.0
"""Times that more of a shape rests on its y side than on its z side before y is up. Of the 251 training models 29 stand
on y then: cat, cow, penguin and others made with y up, and parts that may as well lie on another flat side."""

BEFORE_A_CAMERA = 0.75
"""Share of a surface that faces the origin where that is the depth camera: 0.82 of the wall in docs/orientation.md."""


def upright_axis(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> str:
    """Return the name of the axis that is up on a mesh (v, 3), (f, 3) of any size, f > 0."""
    largest = abs(vertices).max() or 1.0
    return Patches.of_mesh(vertices / largest, faces).upright_axis()


@dataclass(frozen=True)
class Patches:
    """Patches of a surface: corners (f, c, 3), and normals (f, 3) as long as their areas, or all of one length."""

    corners: NDArray[np.float64]
    area_normals: NDArray[np.float64]

    @classmethod
    def of_mesh(cls, vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> Patches:
        """Return the faces (f, 3) of a mesh of `vertices` (v, 3)."""
        return cls(vertices[faces], area_vectors(vertices, faces))

    def mean_normal(self) -> Vector:
        """Return the mean unit normal, by area."""
        return np.asarray(self.area_normals.sum(axis=0) / self._total_area())

    def upright_axis(self, facing: Vector | None = None) -> str:
        """Return the name of the axis that is up: z, unless the surface rests on y, or lies before a depth camera.

        That is at the origin and looks along z, while y points down. `facing` (3,) is where the surface was seen from;
        default: where most of it faces.
        """
        facing = self.mean_normal() if facing is None else facing
        if np.linalg.norm(facing) > OPEN:
            ahead = self.corners[:, :, 2].min() > 0 and facing[2] < -OPEN
            return "-y" if ahead and self._share_facing_origin() > BEFORE_A_CAMERA else "z"
        return "y" if self._resting_on(1) > RESTING * self._resting_on(2) else "z"

    def _share_facing_origin(self) -> float:
        """Return the share of the area that faces the origin."""
        facing = (self.area_normals * self.corners.mean(axis=1)).sum(axis=1) < 0
        return float(np.linalg.norm(self.area_normals[facing], axis=1).sum() / self._total_area())

    def _resting_on(self, axis: int) -> float:
        """Return the share of the shape's footprint along an axis that lies flat at its very bottom.

        So does what is missing of the surface, if most of that is underneath: scanners do not see undersides.
        """
        heights = self.corners[:, :, axis].mean(axis=1)
        bottom = heights < heights.min() + 0.05 * np.ptp(heights)
        footprint = np.delete(np.ptp(self.corners.reshape(-1, 3), axis=0), axis).prod() or 1.0
        flat = -self.area_normals[bottom, axis].clip(max=0).sum()
        missing = self.area_normals.sum(axis=0)  # those of a closed surface cancel
        return float((flat + (missing[axis] if axis == missing.argmax() else 0)) / footprint)

    def _total_area(self) -> float:
        return float(np.linalg.norm(self.area_normals, axis=1).sum()) or 1.0
