# SPDX-License-Identifier: GPL-3.0-or-later
"""From where to look at a surface that nobody has seen before."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.upright import AXES, OPEN, Patches

Vector = NDArray[np.float64]

TURN, RAISE, STEEPEST = np.radians([31, 21, 60])
"""How far the eye is to the right of what it looks at, and above; how far above or below the horizon at most."""


def choose_view(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], sight: Vector | None = None, up: str | None = None
) -> NDArray[np.float64]:
    """Return the rotation (3, 3) into a frame of x to the right, y up and z towards the eye.

    An open scan is seen from the side that was scanned: from where its sensors were, or else from where most of it
    faces; anything else from its front. Both a little from above and from the right.

    Parameters
    ----------
    vertices, faces
        The mesh, (v, 3) and (f, 3), f > 0.
    sight
        (3,), as ``mean_sight`` returns it.
    up
        The axis of that name in ``AXES``; default: as ``Patches.upright_axis`` finds it.
    """
    return _view(Patches.of_mesh(vertices, faces), sight, up)


def choose_view_of_points(
    points: NDArray[np.float64], normals: NDArray[np.float64], sight: Vector | None = None, up: str | None = None
) -> NDArray[np.float64]:
    """Return the rotation that ``choose_view`` would for a surface of points (n, 3) with unit normals (n, 3)."""
    return _view(Patches(points[:, None], normals), sight, up)


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


def _view(patches: Patches, sight: Vector | None, name: str | None) -> NDArray[np.float64]:
    facing = patches.mean_normal()
    if sight is not None and np.linalg.norm(sight) > OPEN:
        facing = sight
    name = name or patches.upright_axis(facing)
    up = AXES[name]
    height = float(facing @ up)
    level = facing - height * up
    if np.linalg.norm(level) <= OPEN:  # from the front: which way it leans is chance
        level = AXES["z"] if name == "y" else AXES["-y"]
    right = _unit(np.cross(up, level))
    aside = np.cos(TURN) * _unit(level) + np.sin(TURN) * right
    elevation = np.clip(np.arcsin(np.clip(height, -1, 1)) + RAISE, -STEEPEST, STEEPEST)
    toward = np.cos(elevation) * aside + np.sin(elevation) * up
    right = _unit(np.cross(up, toward))
    return np.stack([right, np.cross(toward, right), toward])


def _unit(vector: Vector) -> Vector:
    return vector / np.linalg.norm(vector)
