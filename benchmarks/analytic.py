# SPDX-License-Identifier: GPL-3.0-or-later
"""Analytic surfaces, sampled evenly by area, with their true curvature at every sample."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Parametrisation = Callable[[Array, Array], Array]
TAU = 2 * np.pi
STEP = 1e-4
"""Of the finite differences: their error is far below that of any estimate."""


@dataclass(frozen=True)
class Samples:
    """Points of a surface, and what is true of them.

    Attributes
    ----------
    points
        (n, 3), on the surface.
    curvatures, direction1
        (n, 2) k1, k2 with |k1| >= |k2|, convex positive if the normals look out, and the direction (n, 3) of k1.
    """

    points: Array
    curvatures: Array
    direction1: Array


def cylinder(u: Array, v: Array) -> Array:
    """Return an open cylinder of radius 0.5 and height 2."""
    return np.stack([0.5 * np.cos(TAU * u), 0.5 * np.sin(TAU * u), 2 * v], axis=-1)


def torus(u: Array, v: Array) -> Array:
    """Return a torus with radii 1 and 0.4."""
    ring = 1 + 0.4 * np.cos(TAU * v)
    return np.stack([ring * np.cos(TAU * u), ring * np.sin(TAU * u), 0.4 * np.sin(TAU * v)], axis=-1)


def ellipsoid(u: Array, v: Array) -> Array:
    """Return an ellipsoid with half axes 2, 1 and 0.5."""
    ring = np.sin(np.pi * v)
    return np.stack([2 * ring * np.cos(TAU * u), ring * np.sin(TAU * u), -0.5 * np.cos(np.pi * v)], axis=-1)


def saddle(u: Array, v: Array) -> Array:
    """Return the saddle z = (x^2 - 0.4 y^2) over a square of side 2."""
    x, y = 2 * u - 1, 2 * v - 1
    return np.stack([x, y, x**2 - 0.4 * y**2], axis=-1)


def sine_cylinder(u: Array, v: Array) -> Array:
    """Return a cylinder of radius 0.3 whose axis is bent to a sine curve."""
    x = TAU * u
    along = np.stack([np.ones_like(x), 0.6 * np.cos(x), np.zeros_like(x)], axis=-1)
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    across = np.stack([-along[..., 1], along[..., 0], np.zeros_like(x)], axis=-1)
    axis = np.stack([x, 0.6 * np.sin(x), np.zeros_like(x)], axis=-1)
    angle = TAU * v[..., None]
    return axis + 0.3 * (np.cos(angle) * across + np.sin(angle) * np.array([0, 0, 1]))


SURFACES: dict[str, Parametrisation] = {
    surface.__name__: surface for surface in (cylinder, torus, ellipsoid, saddle, sine_cylinder)
}


def samples_of(surface: Parametrisation, count: int, seed: int = 0) -> Samples:
    """Draw `count` points of the surface, uniformly by area."""
    random = np.random.default_rng(seed)
    u, v = random.random((2, 16 * count))
    size = np.linalg.norm(np.cross(*_first_derivatives(surface, u, v)), axis=1)
    # Uniform in (u, v) is not uniform on the surface: keep a draw with a chance proportional to its area.
    kept = np.flatnonzero(random.random(len(size)) * size.max() < size)[:count]
    if len(kept) < count:
        raise ValueError(f"{surface.__name__} stretches its parameters too much to be sampled like this")
    return Samples(surface(u[kept], v[kept]), *curvature_of(surface, u[kept], v[kept]))


def curvature_of(surface: Parametrisation, u: Array, v: Array) -> tuple[Array, Array]:
    """Return k1, k2 (n, 2) and the direction of k1 (n, 3), by the two fundamental forms at parameters u, v (n,)."""
    xu, xv = _first_derivatives(surface, u, v)
    normal = np.cross(xu, xv)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    # The orthonormal frame (a, b) of the tangent plane; X_v = p a + q b.
    length = np.linalg.norm(xu, axis=1, keepdims=True)
    a = xu / length
    b = np.cross(normal, a)
    p, q = (np.einsum("nc,nc->n", xv, each)[:, None] for each in (a, b))
    second = [-np.einsum("nc,nc->n", normal, each)[:, None] for each in _second_derivatives(surface, u, v)]
    aa = second[0] / length**2
    ab = (second[1] - p * length * aa) / (length * q)
    bb = (second[2] - p**2 * aa - 2 * p * q * ab) / q**2
    shape_operators = np.concatenate([aa, ab, ab, bb], axis=1).reshape(-1, 2, 2)
    values, vectors = np.linalg.eigh(shape_operators)
    order = np.argsort(-abs(values), axis=1, kind="stable")
    first = np.take_along_axis(vectors, order[:, None, :1], axis=2)[:, :, 0]
    return np.take_along_axis(values, order, axis=1), first[:, :1] * a + first[:, 1:] * b


def _first_derivatives(surface: Parametrisation, u: Array, v: Array) -> tuple[Array, Array]:
    h = STEP
    return (surface(u + h, v) - surface(u - h, v)) / (2 * h), (surface(u, v + h) - surface(u, v - h)) / (2 * h)


def _second_derivatives(surface: Parametrisation, u: Array, v: Array) -> tuple[Array, Array, Array]:
    h, middle = STEP, surface(u, v)
    uu = (surface(u + h, v) - 2 * middle + surface(u - h, v)) / h**2
    vv = (surface(u, v + h) - 2 * middle + surface(u, v - h)) / h**2
    mixed = surface(u + h, v + h) - surface(u + h, v - h) - surface(u - h, v + h) + surface(u - h, v - h)
    return uu, mixed / (4 * h**2), vv
