# SPDX-License-Identifier: GPL-3.0-or-later
"""Random clouds of every awkward kind, with random options; a case is known by its seed."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from helpers.fuzzing.mesh_checker import faults
from numpy.typing import NDArray

from hdpea import reconstruct
from hdpea.errors import CannotReconstruct, UnreadableInput, UsageError
from hdpea.options import Options
from hdpea.options.settings import filled

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
    axis = random.integers(0, 3, count)
    points[np.arange(count), axis] = random.choice([-1.0, 1.0], count)
    return points * random.uniform(0.01, 1, 3)


def _plane(random: Random, count: int) -> Array:
    return random.uniform(-1, 1, (count, 3)) * [1, 1, random.choice([0, 1e-12, 1e-3])]


def _line(random: Random, count: int) -> Array:
    return random.uniform(-1, 1, (count, 1)) * random.normal(size=3) + random.choice([0, 1e-9]) * random.normal(
        size=(count, 3)
    )


def _lattice(random: Random, count: int) -> Array:
    return random.integers(0, random.integers(2, 8), (count, 3)).astype(np.float64)


def _clusters(random: Random, count: int) -> Array:
    centres = random.normal(size=(random.integers(2, 9), 3))
    return centres[random.integers(0, len(centres), count)] + 10.0 ** random.uniform(-9, -1) * random.normal(
        size=(count, 3)
    )


def _ball(random: Random, count: int) -> Array:
    return random.normal(size=(count, 3))


def _sheets(random: Random, count: int) -> Array:
    points = random.uniform(-1, 1, (count, 3))
    points[:, 2] = random.choice([0, 10.0 ** random.uniform(-6, -0.5)], count)
    return points


SHAPES: list[Callable[[Random, int], Array]] = [
    _sphere,
    _torus,
    _box,
    _plane,
    _line,
    _lattice,
    _clusters,
    _ball,
    _sheets,
]


def _spoilt(random: Random, points: Array) -> Array:
    """Return the points with a few of the things that go wrong with clouds."""
    if random.random() < 0.3:
        points = points + 10.0 ** random.uniform(-9, -0.5) * random.normal(size=points.shape)
    if random.random() < 0.2:
        points = np.vstack([points, points[random.integers(0, len(points), len(points) // 3)]])
    if random.random() < 0.2:
        points = points[points @ random.normal(size=3) > -0.5]
    if random.random() < 0.15:
        points = np.vstack([points, 10.0 ** random.uniform(0, 3) * random.normal(size=(random.integers(1, 4), 3))])
    if random.random() < 0.1:
        points = points * 10.0 ** random.uniform(-160, 160)
    if random.random() < 0.15:
        points = points + 10.0 ** random.uniform(0, 9) * random.normal(size=3)
    if random.random() < 0.15:
        points = points.astype(np.float32).astype(np.float64)
    if random.random() < 0.15 and len(points):
        points = points.copy()
        points[random.integers(0, len(points), 3), random.integers(0, 3, 3)] = random.choice([np.nan, np.inf, -np.inf])
    return points


def _normals(random: Random, points: Array) -> Array | None:
    kind = random.integers(0, 6)
    if kind < 3:
        return None
    with np.errstate(all="ignore"):
        normals = points - points.mean(axis=0) if len(points) else points
    if kind == 4:
        normals = random.normal(size=points.shape)
    if kind == 5:
        normals = np.where(random.random((len(points), 1)) < 0.4, random.choice([0.0, np.nan]), normals)
    return normals


def _settings(random: Random, count: int) -> dict[str, Any]:
    chosen: dict[str, Any] = {"threads": 1}
    if random.random() < 0.5:
        chosen["vertices" if random.random() < 0.7 else "faces"] = int(random.integers(4, max(count, 5)))
    if random.random() < 0.3:
        chosen["watertight"] = True
    if random.random() < 0.3:
        chosen["denoise"] = random.choice(["none", "mls"])
    if random.random() < 0.3:
        chosen["orient"] = random.choice(["wnnc", "mst"])
    if random.random() < 0.2:
        chosen["min_component"] = int(random.integers(0, 40))
    if random.random() < 0.1:
        chosen["embedding"] = "learned"
    if random.random() < 0.2:
        chosen["rounds"] = int(random.integers(0, 4))
    if random.random() < 0.3:
        chosen["iterations"] = int(random.integers(0, 20))
    return {name: str(value) if isinstance(value, np.str_) else value for name, value in chosen.items()}


def cloud(seed: int, most: int = 300) -> tuple[Array, Array | None, dict[str, Any]]:
    """Return points (n, 3), normals (n, 3) or None, and settings by name."""
    random = np.random.default_rng([seed, 1])
    count = int(random.integers(0, most) if random.random() < 0.9 else random.integers(0, 20))
    with np.errstate(all="ignore"):
        points = SHAPES[random.integers(0, len(SHAPES))](random, count)
        points = _spoilt(random, points) if count else points
    return points, _normals(random, points), _settings(random, len(points))


def run(seed: int, most: int = 300) -> str:
    """Reconstruct the cloud of a seed; return how it ended: ``mesh``, or the name of a documented error.

    Raises
    ------
    AssertionError
        If a mesh or its report is wrong. Any other exception is a fault as well, and so is a warning.
    """
    points, normals, settings = cloud(seed, most)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            made = reconstruct(points, normals, filled(Options, settings))
        except (UsageError, UnreadableInput, CannotReconstruct) as error:
            return type(error).__name__
    distinct = np.unique(points[np.isfinite(points).all(axis=1)], axis=0)
    report = json.loads(json.dumps(made.report.as_dict(), default=lambda number: number.item()))
    found = faults(made.vertices, made.faces, distinct, report)
    assert not found, "; ".join(found)
    return "mesh"
