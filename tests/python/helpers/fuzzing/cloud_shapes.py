# SPDX-License-Identifier: GPL-3.0-or-later
"""Points of every awkward arrangement, at random."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Random = np.random.Generator


def _sphere(random: Random, count: int) -> Array:
    directions = random.normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=1, keepdims=True).clip(min=1e-12)


def _torus(random: Random, count: int) -> Array:
    u, v = random.uniform(0, 2 * np.pi, (2, count))
    radius = 1 + random.uniform(0.05, 1.2) * np.cos(v)
    return np.stack([radius * np.cos(u), radius * np.sin(u), np.sin(v) * 0.4], axis=1)


def _box(random: Random, count: int) -> Array:
    points = random.uniform(-1, 1, (count, 3))
    points[np.arange(count), random.integers(0, 3, count)] = random.choice([-1.0, 1.0], count)
    return points * random.uniform(0.01, 1, 3)


def _plane(random: Random, count: int) -> Array:
    return random.uniform(-1, 1, (count, 3)) * [1, 1, random.choice([0, 1e-15, 1e-12, 1e-3])]


def _line(random: Random, count: int) -> Array:
    across = random.choice([0, 1e-9]) * random.normal(size=(count, 3))
    return random.uniform(-1, 1, (count, 1)) * random.normal(size=3) + across


def _curve(random: Random, count: int) -> Array:
    t = random.uniform(0, 2 * np.pi * random.integers(1, 5), count)
    return np.stack([np.cos(t), np.sin(t), random.choice([0, 0.1]) * t], axis=1)


def _lattice(random: Random, count: int) -> Array:
    return random.integers(0, random.integers(2, 8), (count, 3)).astype(np.float64)


def _grid(random: Random, count: int) -> Array:
    side = max(int(count**0.5), 1)
    x, y = (each.ravel().astype(np.float64) for each in np.meshgrid(np.arange(side), np.arange(side)))
    height = [
        0 * x,
        x * y,
        (x - side / 2) ** 2,
        np.abs(x - side / 2),
        random.integers(0, 2, x.shape).astype(np.float64),
    ]
    return np.stack([x, y, height[random.integers(0, len(height))] * random.choice([0.01, 1])], axis=1)


def _clusters(random: Random, count: int) -> Array:
    centres = random.normal(size=(random.integers(2, 9), 3))
    spread = 10.0 ** random.uniform(-16, -1)
    return centres[random.integers(0, len(centres), count)] + spread * random.normal(size=(count, 3))


def _ball(random: Random, count: int) -> Array:
    return random.normal(size=(count, 3))


def _spokes(random: Random, count: int) -> Array:
    directions = random.normal(size=(random.integers(1, 7), 3))
    return directions[random.integers(0, len(directions), count)] * random.uniform(0, 1, (count, 1))


def _sheets(random: Random, count: int) -> Array:
    points = random.uniform(-1, 1, (count, 3))
    points[:, 2] = random.choice([0, 10.0 ** random.uniform(-6, -0.5)], count)
    return points


def _crossing(random: Random, count: int) -> Array:
    points = random.uniform(-1, 1, (count, 3))
    points[np.arange(count), random.integers(0, random.integers(2, 4), count)] = 0
    return points


def _moebius(random: Random, count: int) -> Array:
    u, v = random.uniform(0, 2 * np.pi, count), random.uniform(-0.4, 0.4, count)
    radius = 1 + v * np.cos(u / 2)
    return np.stack([radius * np.cos(u), radius * np.sin(u), v * np.sin(u / 2)], axis=1)


def _touching(random: Random, count: int) -> Array:
    return _sphere(random, count) + random.choice([-1.0, 1.0], (count, 1)) * [random.choice([0.9, 1, 1.001]), 0, 0]


SHAPES: list[Callable[[Random, int], Array]] = [
    _sphere,
    _torus,
    _box,
    _plane,
    _line,
    _curve,
    _lattice,
    _grid,
    _clusters,
    _ball,
    _spokes,
    _sheets,
    _crossing,
    _moebius,
    _touching,
]


def spoilt(random: Random, points: Array) -> Array:
    """Return points (n, 3), n > 0, with some of the things that go wrong with clouds: noise, copies, holes, strays,
    far origins, tiny and huge units, single precision, numbers that are none."""
    if random.random() < 0.3:
        points = points + 10.0 ** random.uniform(-9, -0.5) * random.normal(size=points.shape)
    if random.random() < 0.2:
        points = np.vstack([points, points[random.integers(0, len(points), len(points) // 3)]])
    if random.random() < 0.1:
        points = np.vstack([points, np.nextafter(points, random.choice([-np.inf, np.inf]))])
    if random.random() < 0.2:
        points = points[points @ random.normal(size=3) > -0.5]
    if random.random() < 0.15:
        points = np.vstack([points, 10.0 ** random.uniform(0, 3) * random.normal(size=(random.integers(1, 4), 3))])
    if random.random() < 0.1:
        points = points * 10.0 ** random.uniform(-320, 308)
    if random.random() < 0.05:
        points = points * 10.0 ** random.uniform(-12, 12, 3)
    if random.random() < 0.15:
        points = points + 10.0 ** random.uniform(0, 17) * random.normal(size=3)
    if random.random() < 0.15 and len(points):
        points = points.copy()
        points[random.integers(0, len(points), 3), random.integers(0, 3, 3)] = random.choice([np.nan, np.inf, -np.inf])
    return points
