# SPDX-License-Identifier: GPL-3.0-or-later
"""From where to look at a surface that nobody has seen before."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.triangles import area_vectors

Vector = NDArray[np.float64]

Y, Z = np.eye(3)[1:]
OPEN = 0.2
"""Length of the mean unit normal from which a surface counts as open: a closed one has 0, a plane 1."""


def choose_view(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the rotation (3, 3) into a frame of x to the right, y up and z towards the eye.

    An open scan is seen from the side it faces, anything else from its front; both a little from
    above and from the right. What is up is guessed: z or y, whichever the shape rests on.

    Parameters
    ----------
    vertices, faces
        The mesh, (v, 3) and (f, 3), f > 0.
    """
    return _view(vertices[faces], area_vectors(vertices, faces))


def choose_view_of_points(points: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rotation that ``choose_view`` would for a surface of points (n, 3) with unit normals (n, 3)."""
    return _view(points[:, None], normals)


def _view(corners: NDArray[np.float64], area_normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Choose for patches with corners (f, c, 3) and normals (f, 3) as long as their areas, or all of one length."""
    total_area = np.linalg.norm(area_normals, axis=1).sum() or 1.0
    facing = area_normals.sum(axis=0) / total_area
    if np.linalg.norm(facing) > OPEN:
        up = Y if abs(facing[2]) > 0.7 * np.linalg.norm(facing) else Z
    else:
        rests_on_y = _base(corners, area_normals, 1) > _base(corners, area_normals, 2)
        up, facing = (Y, Z) if rests_on_y else (Z, -Y)
    return _look(facing, up)


def _base(corners: NDArray[np.float64], area_normals: NDArray[np.float64], axis: int) -> float:
    """Return the share of the shape's footprint along an axis that lies flat at its very bottom."""
    heights = corners[:, :, axis].mean(axis=1)
    bottom = heights < heights.min() + 0.05 * np.ptp(heights)
    footprint = np.delete(np.ptp(corners.reshape(-1, 3), axis=0), axis).prod() or 1.0
    return float(-area_normals[bottom, axis].clip(max=0).sum() / footprint)


def _look(facing: Vector, up: Vector) -> NDArray[np.float64]:
    toward = facing / np.linalg.norm(facing)
    right = _unit(np.cross(up, toward))
    toward = _unit(toward + 0.6 * right + 0.45 * np.cross(toward, right))
    right = _unit(np.cross(up, toward))
    return np.stack([right, np.cross(toward, right), toward])


def _unit(vector: Vector) -> Vector:
    return vector / np.linalg.norm(vector)
