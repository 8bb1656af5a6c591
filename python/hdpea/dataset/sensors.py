# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a simulated sensor stands, and the rays it casts."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.augmentation import random_rotation
from hdpea.dataset.options import ScanOptions

TAU = 2 * np.pi

MODEL_RADIUS = 0.5
"""Of the ball around the middle of the unit frame that holds the model: half its diagonal."""

ELEVATIONS = (TAU / 24, TAU / 9, TAU / 6)
"""Of the turntable's sensor above the horizon; never below it, so what stands on the table stays unseen."""

GOLDEN_ANGLE = TAU * (2 - (1 + 5**0.5) / 2)
JITTER = 0.05
"""Std in radians of where the sensor stands, so that no two models are seen from the same places."""


def sensor_positions(options: ScanOptions, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return where the sensor stands (views, 3) in the unit frame.

    ``views``: a Fibonacci spiral on the sphere, or on a cap of it around a random direction if the coverage is less
    than 1. ``turntable``: one after the other at each of the elevations while the model turns, from a random angle on.
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
    """Return unit directions (r, 3) from `position` (3,): a square grid of pixels, round enough to hold the model.

    Parameters
    ----------
    position
        Where the camera stands; it looks at the origin.
    resolution
        Pixels across.
    roll
        Angle in radians by which the camera is turned about its axis.
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
