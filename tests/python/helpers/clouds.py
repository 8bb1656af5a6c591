# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds of analytic surfaces, uniform by area, with exact outward normals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Cloud = tuple[Array, Array]
"""Points (n, 3) and normals (n, 3)."""

TAU = 2 * np.pi


def sphere_points(count: int, seed: int = 0) -> Array:
    """Return points (count, 3) of the unit sphere, which are their own normals."""
    points = np.random.default_rng(seed).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


def sphere(count: int, seed: int = 0) -> Cloud:
    """Return a unit sphere."""
    points = sphere_points(count, seed)
    return points, points.copy()


def hollow_sphere(count: int, spacings_thick: float) -> Cloud:
    """Return a unit sphere, and inside it another that faces inwards: the two sides of a thin wall."""
    thickness = spacings_thick * (4 * np.pi / (count / 2)) ** 0.5
    (outer, out), (inner, _) = sphere(count // 2, seed=1), sphere(count // 2, seed=2)
    return np.vstack([outer, (1 - thickness) * inner]), np.vstack([out, -inner])


def torus(count: int, seed: int = 0) -> Cloud:
    """Return a torus with radii 1 and 0.4."""
    random = np.random.default_rng(seed)
    u, v = TAU * random.random((2, 3 * count))
    kept = random.random(3 * count) < (1 + 0.4 * np.cos(v)) / 1.4  # the outside has more area than the inside
    u, v = u[kept][:count], v[kept][:count]
    normals = np.stack([np.cos(v) * np.cos(u), np.cos(v) * np.sin(u), np.sin(v)], axis=1)
    return np.stack([np.cos(u), np.sin(u), 0 * u], axis=1) + 0.4 * normals, normals


def ellipsoid(count: int, seed: int = 0) -> Cloud:
    """Return an ellipsoid with half axes 1, 0.6 and 0.4."""
    axes = np.array([1, 0.6, 0.4])
    on_sphere, _ = sphere(5 * count, seed)
    normals = on_sphere / axes
    stretch = np.linalg.norm(normals, axis=1)  # of area, up to a constant
    kept = np.random.default_rng(seed + 1).random(len(stretch)) < stretch / stretch.max()
    return (axes * on_sphere)[kept][:count], (normals / stretch[:, None])[kept][:count]


def box(count: int, size: tuple[float, float, float] = (1, 1, 1), seed: int = 0) -> Cloud:
    """Return a box with sharp edges; of size (1, 1, 0.1), a thin plate."""
    random = np.random.default_rng(seed)
    extent = np.array(size)
    areas = extent.prod() / extent
    axis = random.choice(3, count, p=areas / areas.sum())
    side = random.choice([-1.0, 1.0], count)
    points = random.random((count, 3)) - 0.5
    points[np.arange(count), axis] = side / 2
    normals = np.zeros((count, 3))
    normals[np.arange(count), axis] = side
    return points * extent, normals


def cylinder(count: int, seed: int = 0) -> Cloud:
    """Return the side of a cylinder of radius 0.5 and height 2: open, with two borders."""
    u, v = np.random.default_rng(seed).random((2, count))
    normals = np.stack([np.cos(TAU * u), np.sin(TAU * u), 0 * u], axis=1)
    return 0.5 * normals + np.stack([0 * v, 0 * v, 2 * v], axis=1), normals


def can(count: int, seed: int = 0) -> Cloud:
    """Return a cylinder of radius 0.5 and height 1 with its two lids."""
    random = np.random.default_rng(seed)
    u, v = random.random((2, count))
    lid = random.random(count) < 1 / 3
    around = np.stack([np.cos(TAU * u), np.sin(TAU * u), 0 * u], axis=1)
    up = np.stack([0 * u, 0 * u, np.where(random.random(count) < 0.5, -1.0, 1.0)], axis=1)
    points = np.where(lid[:, None], 0.5 * np.sqrt(v)[:, None] * around + 0.5 * up, 0.5 * around)
    points[~lid, 2] = v[~lid] - 0.5
    return points, np.where(lid[:, None], up, around)


def plane(count: int, height: float = 0, seed: int = 0) -> Cloud:
    """Return a horizontal unit square."""
    u, v = np.random.default_rng(seed).random((2, count))
    return np.stack([u, v, np.full(count, height)], axis=1), np.tile([0.0, 0.0, 1.0], (count, 1))


def two_sheets(count: int, spacings_apart: float, facing: float) -> Cloud:
    """Return two parallel unit squares; `facing` is 1 if their normals are the same, -1 if opposite."""
    spacing = (count / 2) ** -0.5
    (low, down), (high, up) = plane(count // 2, seed=1), plane(count // 2, spacings_apart * spacing, seed=2)
    return np.vstack([low, high]), np.vstack([facing * down, up])


CLOSED: dict[str, Callable[[int], Cloud]] = {
    "sphere": sphere,
    "torus": torus,
    "ellipsoid": ellipsoid,
    "cube": box,
    "plate": lambda count: box(count, (1, 1, 0.1)),
}
GENUS = {"sphere": 0, "torus": 1, "ellipsoid": 0, "cube": 0, "plate": 0}
