# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of a simulated scan: pixels that fly off edges, views that are badly registered, coarse coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.options import ScanOptions
from hdpea.dataset.sensor_rays import Rays

Rows = NDArray[np.float64]

DEPTH_JUMP = 0.03
"""How far, as a share of the diagonal, the nearer of two surfaces is before the farther at a jump in depth."""


def at_depth_jumps(
    rays: Rays, hits: NDArray[np.int64], surface_points: Rows, normals: Rows, ranges: Rows
) -> NDArray[np.bool_]:
    """Return for each hit (h,) whether a neighbouring pixel sees a surface well before or behind its own.

    That is so where the nearer point lies before the tangent plane of the farther. It does not on a convex body,
    however steeply it is looked at and however coarse the pixels are.

    Parameters
    ----------
    hits
        (h,): indices of the rays that hit.
    surface_points, normals, ranges
        (h, 3), (h, 3) and (h,): where they hit, the normals there, and the distances from the sensor.
    """
    pixels = tuple(rays.pixels[hits].T)
    hit_at = np.full(rays.grid, -1)
    hit_at[pixels] = np.arange(len(hits))
    jumps = np.zeros(len(hits), np.bool_)
    for one, other in ((hit_at[:-1], hit_at[1:]), (hit_at[:, :-1], hit_at[:, 1:])):
        pairs = np.stack([one, other], axis=-1)[(one >= 0) & (other >= 0)]
        nearer, farther = np.take_along_axis(pairs, ranges[pairs].argsort(axis=1), axis=1).T
        before = ((surface_points[nearer] - surface_points[farther]) * normals[farther]).sum(axis=1)
        jumps[pairs[before > DEPTH_JUMP]] = True
    return jumps


def flights(jumps: NDArray[np.bool_], options: ScanOptions, rng: np.random.Generator) -> Rows:
    """Return how far behind the surface each point (n,) is measured; 0 but for a share of those at jumps in depth.

    A pixel that sees two surfaces at once measures a range between theirs, so that edges trail points behind them.
    """
    flying = jumps & (rng.random(len(jumps)) < options.flying)
    return np.where(flying, options.flying_length * rng.random(len(jumps)), 0.0)


@dataclass(frozen=True)
class Misplacement:
    """The rigid motion of a view that is badly registered: a rotation (3, 3) about the origin, then a shift (3,)."""

    rotation: Rows
    shift: Rows

    def of(self, points: Rows) -> Rows:
        """Return points (n, 3) moved."""
        moved: Rows = points @ self.rotation.T + self.shift
        return moved


def misplacements(options: ScanOptions, rng: np.random.Generator) -> list[Misplacement]:
    """Return the misplacement of each view, of random axes and directions."""
    axes = rng.standard_normal((options.views, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    shifts = options.misplaced / 3**0.5 * rng.standard_normal((options.views, 3))
    angle = np.radians(options.misrotated)
    return [Misplacement(_rotation(axis, angle), shift) for axis, shift in zip(axes, shifts, strict=True)]


def _rotation(axis: Rows, angle: float) -> Rows:
    """Return the rotation about a unit axis by an angle in radians (Rodrigues' formula)."""
    cross = np.cross(np.eye(3), -axis)  # cross @ p = axis x p
    rotation: Rows = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return rotation


def quantised(points: Rows, step: float) -> Rows:
    """Return points (n, 3) with each coordinate at the nearest multiple of `step`."""
    return np.asarray(step * np.rint(points / step))
