# SPDX-License-Identifier: GPL-3.0-or-later
"""From where to look at a surface that nobody has seen before."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.triangles import area_vectors

Vector = NDArray[np.float64]

Y: Vector = np.array([0.0, 1, 0])
Z: Vector = np.array([0.0, 0, 1])
OPEN = 0.15
"""Length of the mean unit normal from which a surface counts as open: a closed one has 0, a plane 1. Scans of whole
objects without their undersides have up to 0.12, single views from 0.3 on."""

RESTING = 3.0
"""Times that more of a shape rests on its y side than on its z side before y is up. Of the 251 training models 29 stand
on y then: cat, cow, penguin and others made with y up, and parts that may as well lie on another flat side."""

BEFORE_A_CAMERA = 0.75
"""Share of a surface that faces the origin where that is the depth camera: 0.82 of the wall in docs/orientation.md."""

TURN, RAISE, STEEPEST = np.radians([31, 21, 60])
"""How far the eye is to the right of what it looks at, and above; how far above or below the horizon at most."""


@dataclass(frozen=True)
class _Patches:
    """Patches of a surface: corners (f, c, 3), and normals (f, 3) as long as their areas, or all of one length."""

    corners: NDArray[np.float64]
    area_normals: NDArray[np.float64]

    def mean_normal(self) -> Vector:
        """Return the mean unit normal, by area."""
        return np.asarray(self.area_normals.sum(axis=0) / self._total_area())

    def share_facing_origin(self) -> float:
        """Return the share of the area that faces the origin."""
        facing = (self.area_normals * self.corners.mean(axis=1)).sum(axis=1) < 0
        return float(np.linalg.norm(self.area_normals[facing], axis=1).sum() / self._total_area())

    def resting_on(self, axis: int) -> float:
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


def choose_view(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], sight: Vector | None = None
) -> NDArray[np.float64]:
    """Return the rotation (3, 3) into a frame of x to the right, y up and z towards the eye.

    An open scan is seen from the side that was scanned: from where its sensors were, or else from where most of it
    faces; anything else from its front. Both a little from above and from the right. Up is z, unless the surface rests
    on y, or lies before a depth camera at the origin, which looks along z while y points down.

    Parameters
    ----------
    vertices, faces
        The mesh, (v, 3) and (f, 3), f > 0.
    sight
        (3,), as ``mean_sight`` returns it.
    """
    return _view(_Patches(vertices[faces], area_vectors(vertices, faces)), sight)


def choose_view_of_points(
    points: NDArray[np.float64], normals: NDArray[np.float64], sight: Vector | None = None
) -> NDArray[np.float64]:
    """Return the rotation that ``choose_view`` would for a surface of points (n, 3) with unit normals (n, 3)."""
    return _view(_Patches(points[:, None], normals), sight)


def mean_sight(points: NDArray[Any], sensors: NDArray[Any] | None) -> Vector | None:
    """Return the mean of the unit vectors from points (n, 3) to their sensors (n, 3): short if these were all around.

    None if there are no sensors whose positions are known.
    """
    if sensors is None:
        return None
    towards = sensors - points
    lengths = np.linalg.norm(towards, axis=1)
    known = np.isfinite(lengths) & (lengths > 0)
    return np.asarray((towards[known] / lengths[known, None]).mean(axis=0)) if known.any() else None


def _view(patches: _Patches, sight: Vector | None) -> NDArray[np.float64]:
    facing = patches.mean_normal()
    if sight is not None and np.linalg.norm(sight) > OPEN:
        facing = sight
    up = _up(patches, facing)
    height = float(facing @ up)
    level = facing - height * up
    if np.linalg.norm(level) <= OPEN:  # from the front: which way it leans is chance
        level = Z if up is Y else -Y
    right = _unit(np.cross(up, level))
    aside = np.cos(TURN) * _unit(level) + np.sin(TURN) * right
    elevation = np.clip(np.arcsin(np.clip(height, -1, 1)) + RAISE, -STEEPEST, STEEPEST)
    toward = np.cos(elevation) * aside + np.sin(elevation) * up
    right = _unit(np.cross(up, toward))
    return np.stack([right, np.cross(toward, right), toward])


def _up(patches: _Patches, facing: Vector) -> Vector:
    if np.linalg.norm(facing) > OPEN:
        ahead = patches.corners[:, :, 2].min() > 0 and facing[2] < -OPEN
        return -Y if ahead and patches.share_facing_origin() > BEFORE_A_CAMERA else Z
    return Y if patches.resting_on(1) > RESTING * patches.resting_on(2) else Z


def _unit(vector: Vector) -> Vector:
    return vector / np.linalg.norm(vector)
