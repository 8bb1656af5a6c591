# SPDX-License-Identifier: GPL-3.0-or-later
"""Positions of a simulated sensor."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.augmentation import random_rotation
from hdpea.dataset.options import ScanOptions
from hdpea.geometry.directions import TAU, directions_of, fibonacci_spiral, on_sphere

ELEVATIONS = {"turntable": (TAU / 24, TAU / 9, TAU / 6), "lidar": (-TAU / 18, 0.0, TAU / 18)}
"""Elevations of sensors above the horizon. A turntable's never sees the underside of the model."""

JITTER = 0.05
"""Std in radians of the direction of the sensor, so that no two models are seen from the same positions."""


def sensor_positions(options: ScanOptions, rng: np.random.Generator) -> NDArray[np.float64]:
    """Return the positions (views, 3) of the sensor in the unit frame.

    ``views``: a Fibonacci spiral on the sphere, or on a cap of it around a random direction if the coverage is less
    than 1. ``turntable``, ``lidar``: at each of the elevations in turn, along a circle that starts at a random angle.
    """
    if options.sensor in ELEVATIONS:
        azimuth = TAU * (options.coverage * np.arange(options.views) / options.views + rng.random())
        elevation = np.resize(ELEVATIONS[options.sensor], options.views)
        directions = on_sphere(azimuth, np.sin(elevation))
    else:
        directions = fibonacci_spiral(options.views, options.coverage) @ random_rotation(rng).T
    directions += JITTER * rng.standard_normal(directions.shape)
    return options.distance * directions_of(directions)
