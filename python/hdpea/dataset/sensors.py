# SPDX-License-Identifier: GPL-3.0-or-later
"""Positions of a simulated sensor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.augmentation import random_rotation
from hdpea.dataset.options import ScanOptions

TAU = 2 * np.pi

ELEVATIONS = {"turntable": (TAU / 24, TAU / 9, TAU / 6), "lidar": (-TAU / 18, 0.0, TAU / 18)}
"""Elevations of sensors above the horizon. A turntable's never sees the underside of the model."""

GOLDEN_ANGLE = TAU * (2 - (1 + 5**0.5) / 2)
JITTER = 0.05
"""Std in radians of the direction of the sensor, so that no two models are seen from the same positions."""


def sensor_positions(options: ScanOptions, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return the positions (views, 3) of the sensor in the unit frame.

    ``views``: a Fibonacci spiral on the sphere, or on a cap of it around a random direction if the coverage is less
    than 1. ``turntable``, ``lidar``: at each of the elevations in turn, along a circle that starts at a random angle.
    """
    each = np.arange(options.views)
    if options.sensor in ELEVATIONS:
        azimuth = TAU * (options.coverage * each / options.views + rng.random())
        elevation = np.resize(ELEVATIONS[options.sensor], options.views)
        directions = _on_sphere(azimuth, np.sin(elevation))
    else:
        height: NDArray[np.float64] = 1 - 2 * options.coverage * (each + 0.5) / options.views
        directions = _on_sphere(GOLDEN_ANGLE * each.astype(np.float64), height) @ random_rotation(rng).T
    directions += JITTER * rng.standard_normal(directions.shape)
    return options.distance * _unit(directions)


def _on_sphere(azimuth: NDArray[np.float64], height: NDArray[np.float64]) -> NDArray[np.float64]:
    radius = np.sqrt(1 - height**2)
    return np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), height], axis=1)


def _unit(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    unit: NDArray[np.float64] = vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
    return unit
