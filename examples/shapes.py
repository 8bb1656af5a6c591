# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds of analytic shapes, sampled uniformly by area, with exact normals.

As a command:   python examples/shapes.py knot knot.ply --points 40000 --noise 0.001
From Python:    points, normals = sample("knot", 40_000, seed=0)
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray
from plyfile import PlyData, PlyElement

Array = NDArray[np.float64]
TAU = 2 * np.pi


def torus(u: Array, v: Array) -> Array:
    """Return a torus with radii 1 and 0.4."""
    ring = 1 + 0.4 * np.cos(TAU * v)
    return np.stack([ring * np.cos(TAU * u), ring * np.sin(TAU * u), 0.4 * np.sin(TAU * v)], axis=-1)


def ellipsoid(u: Array, v: Array) -> Array:
    """Return an ellipsoid with half axes 2, 1 and 0.5."""
    latitude = np.pi * (v - 0.5)
    around = np.cos(latitude)
    return np.stack([2 * around * np.cos(TAU * u), around * np.sin(TAU * u), 0.5 * np.sin(latitude)], axis=-1)


def bumps(u: Array, v: Array) -> Array:
    """Return a unit sphere with waves on it."""
    latitude = np.pi * (v - 0.5)
    radius = 1 + 0.1 * np.cos(5 * TAU * u) * np.cos(latitude) ** 5
    around = np.cos(latitude)
    return radius[..., None] * np.stack([around * np.cos(TAU * u), around * np.sin(TAU * u), np.sin(latitude)], axis=-1)


def cone(u: Array, v: Array) -> Array:
    """Return the side of a cone cut off at both ends: open, with two borders, and flat along its lines."""
    radius = 1 - 0.7 * v
    return np.stack([radius * np.cos(TAU * u), radius * np.sin(TAU * u), 2 * v], axis=-1)


def knot(u: Array, v: Array) -> Array:
    """Return a tube of radius 0.25 along a trefoil knot."""

    def centre(t: Array) -> Array:
        return np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=-1) / 2

    t = TAU * u
    along = centre(t + 1e-4) - centre(t - 1e-4)
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    across = np.cross(along, [0, 0, 1])
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    up = np.cross(across, along)
    angle = TAU * v[..., None]
    return centre(t) + 0.25 * (np.cos(angle) * across + np.sin(angle) * up)


SHAPES: dict[str, Callable[[Array, Array], Array]] = {
    shape.__name__: shape for shape in (torus, ellipsoid, bumps, cone, knot)
}


def sample(name: str, count: int, seed: int = 0, noise: float = 0.0) -> tuple[Array, Array]:
    """Return `count` points (n, 3) of the shape and their unit normals (n, 3).

    `noise` is the standard deviation of a normal displacement of every coordinate, in the shape's own units.
    """
    surface, random = SHAPES[name], np.random.default_rng(seed)
    points, normals = np.empty((0, 3)), np.empty((0, 3))
    while len(points) < count:
        u, v = random.random((2, 4 * count))
        step = 1e-5
        area = np.cross(
            surface(u + step, v) - surface(u - step, v),
            surface(u, v + step) - surface(u, v - step),
        )
        size = np.linalg.norm(area, axis=1)
        # Uniform in (u, v) is not uniform on the surface: keep a draw with a chance proportional to its area.
        kept = random.random(len(size)) * size.max() < size
        points = np.vstack([points, surface(u[kept], v[kept])])
        normals = np.vstack([normals, area[kept] / size[kept, None]])
    points, normals = points[:count], normals[:count]
    return points + noise * random.standard_normal(points.shape), normals


def write_ply(path: Path, points: Array, normals: Array) -> None:
    """Write a binary PLY of doubles."""
    rows = np.rec.fromarrays([*points.T, *normals.T], names="x,y,z,nx,ny,nz")
    PlyData([PlyElement.describe(rows, "vertex")]).write(path)


@click.command()
@click.argument("shape", type=click.Choice(list(SHAPES)))
@click.argument("out", type=click.Path(path_type=Path))
@click.option("--points", default=40_000, show_default=True)
@click.option("--noise", default=0.0, show_default=True, help="standard deviation, in the shape's own units")
@click.option("--seed", default=0, show_default=True)
def main(shape: str, out: Path, points: int, noise: float, seed: int) -> None:
    """Write a cloud of SHAPE to OUT, a PLY file."""
    write_ply(out, *sample(shape, points, seed, noise))


if __name__ == "__main__":
    main()
