# SPDX-License-Identifier: GPL-3.0-or-later
"""The rays that a simulated sensor casts: the pixels of a camera, or the beams of a rotating lidar."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.directions import directions_of

MODEL_RADIUS = 0.5
"""Radius of the ball around the origin of the unit frame that contains the model: half its diagonal."""


@dataclass(frozen=True)
class Rays:
    """Rays from one position, only those towards the ball of the model.

    Attributes
    ----------
    directions
        (r, 3) float64, unit.
    pixels
        (r, 2) int64: row and column of each in the grid; neighbours there are neighbours in direction.
    grid
        Rows and columns of the grid.
    """

    directions: NDArray[np.float64]
    pixels: NDArray[np.int64]
    grid: tuple[int, int]


def camera_rays(position: NDArray[np.float64], resolution: int, roll: float) -> Rays:
    """Return the pixels of a camera at `position` (3,): a square grid, cropped to the disk of the model.

    Parameters
    ----------
    position
        Position of the camera, which looks at the origin.
    resolution
        Pixels across the grid.
    roll
        Rotation of the camera about its axis, in radians.
    """
    distance = float(np.linalg.norm(position))
    forward = -position / distance
    aside = np.cross(forward, np.eye(3)[np.argmin(abs(forward))])
    aside /= np.linalg.norm(aside)
    right = np.cos(roll) * aside + np.sin(roll) * np.cross(forward, aside)
    across = (np.arange(resolution) + 0.5) * 2 / resolution - 1
    x, y = (grid.ravel() for grid in np.meshgrid(across, across))
    seen = np.flatnonzero(x**2 + y**2 <= 1)
    opening = MODEL_RADIUS / (distance**2 - MODEL_RADIUS**2) ** 0.5  # tangent of half the angle of view
    plane = np.outer(x[seen], right) + np.outer(y[seen], np.cross(forward, right))
    pixels = np.stack(np.divmod(seen, resolution), axis=1)
    return Rays(directions_of(forward + opening * plane), pixels, (resolution, resolution))


def lidar_rays(position: NDArray[np.float64], resolution: int, ring_ratio: float) -> Rays:
    """Return the beams of a lidar at `position` (3,) that rotates about z: rings, each of one elevation.

    Parameters
    ----------
    position
        Position of the lidar, not above or below the model.
    resolution
        Square root of the number of beams in a square as wide as the model, roughly.
    ring_ratio
        Angle between rings, over the angle between the beams of a ring.
    """
    distance = float(np.linalg.norm(position))
    half = np.arcsin(MODEL_RADIUS / distance)
    rings = max(round(resolution / ring_ratio**0.5), 1)
    step = 2 * half / rings
    elevations = np.arcsin(-position[2] / distance) + step * (np.arange(rings) + 0.5) - half
    widest = np.arcsin(min(MODEL_RADIUS / float(np.hypot(*position[:2])), 1.0))  # azimuth of the model
    beams = int(np.ceil(2 * widest * ring_ratio / step))
    azimuths = np.arctan2(-position[1], -position[0]) + 2 * widest * ((np.arange(beams) + 0.5) / beams - 0.5)
    elevation, azimuth = (grid.ravel() for grid in np.meshgrid(elevations, azimuths, indexing="ij"))
    level = np.cos(elevation)
    directions = np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=1)
    towards = np.flatnonzero(directions @ -position >= distance * np.cos(half))
    return Rays(directions[towards], np.stack(np.divmod(towards, beams), axis=1), (rings, beams))
