# SPDX-License-Identifier: GPL-3.0-or-later
"""Positions of a simulated sensor, and the rays it casts."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.augmentation import random_rotation
from hdpea.dataset.options import ScanOptions

TAU = 2 * np.pi

MODEL_RADIUS = 0.5
"""Radius of the ball around the origin of the unit frame that contains the model: half its diagonal."""

ELEVATIONS = (TAU / 24, TAU / 9, TAU / 6)
"""Elevations of the turntable's sensor above the horizon; the underside of the model is never seen."""

GOLDEN_ANGLE = TAU * (2 - (1 + 5**0.5) / 2)
JITTER = 0.05
"""Std in radians of the direction of the sensor, so that no two models are seen from the same positions."""


def sensor_positions(options: ScanOptions, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return the positions (views, 3) of the sensor in the unit frame.

    ``views``: a Fibonacci spiral on the sphere, or on a cap of it around a random direction if the coverage is less
    than 1. ``turntable``: at each of the elevations in turn while the model rotates, starting at a random angle.
    """
    each = np.arange(options.views)
    if options.sensor == "turntable":
        azimuth = TAU * (options.coverage * each / options.views + rng.random())
        elevation = np.resize(ELEVATIONS, options.views)
        directions = _on_sphere(azimuth, np.sin(elevation))
    else:
        height: NDArray[np.float64] = 1 - 2 * options.coverage * (each + 0.5) / options.views
        directions = _on_sphere(GOLDEN_ANGLE * each.astype(np.float64), height) @ random_rotation(rng).T
    directions += JITTER * rng.standard_normal(directions.shape)
    return options.distance * _unit(directions)


def camera_rays(position: NDArray[np.float64], resolution: int, roll: float) -> NDArray[np.float64]:
    """Return unit directions (r, 3) from `position` (3,): a square grid of pixels, cropped to the disk of the model.

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
    seen = x**2 + y**2 <= 1
    opening = MODEL_RADIUS / (distance**2 - MODEL_RADIUS**2) ** 0.5  # tangent of half the angle of view
    plane = np.outer(x[seen], right) + np.outer(y[seen], np.cross(forward, right))
    return _unit(forward + opening * plane)


def _on_sphere(azimuth: NDArray[np.float64], height: NDArray[np.float64]) -> NDArray[np.float64]:
    radius = np.sqrt(1 - height**2)
    return np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), height], axis=1)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    unit: NDArray[np.float64] = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    return unit
