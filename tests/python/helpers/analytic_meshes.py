# SPDX-License-Identifier: GPL-3.0-or-later
"""Analytic surfaces as meshes, tessellated at will, with the true curvature anywhere on them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mesh = tuple[Array, NDArray[np.int64]]
"""Vertices (v, 3) and faces (f, 3)."""

TAU = 2 * np.pi
STEP = 1e-3
"""Of the finite differences: their error is a millionth, far below any bound on curvature."""


@dataclass(frozen=True)
class Analytic:
    """A surface: the zeros of `level`, which grows outward, and the points of parameters u, v in [0, 1].

    Attributes
    ----------
    level, point
        (n, 3) -> (n,), and u (n,), v (n,) -> (n, 3).
    regular, needles
        Steps along u and v: for triangles about as long as wide, and for triangles many times as long.
    wraps
        Whether u and v come round.
    capped
        Whether the borders at v = 0 and v = 1 are closed by flat fans.
    """

    level: Callable[[Array], Array]
    point: Callable[[Array, Array], Array]
    regular: tuple[int, int]
    needles: tuple[int, int]
    wraps: tuple[bool, bool] = (False, False)
    capped: bool = False

    def mesh(self, tessellation: str) -> Mesh:
        """Return the surface, tessellated as ``regular`` or as ``needles``; without faces that have no area."""
        steps = self.regular if tessellation == "regular" else self.needles
        rows = [np.arange(n if wraps else n + 1) for n, wraps in zip(steps, self.wraps, strict=True)]
        u, v = (each.ravel() for each in np.meshgrid(rows[0] / steps[0], rows[1] / steps[1], indexing="ij"))
        faces = _grid(steps, (len(rows[0]), len(rows[1])))
        vertices = self.point(u, v)
        if self.capped:
            vertices, faces = _capped(vertices, faces, steps)
        distinct, index = np.unique(vertices.round(12), axis=0, return_inverse=True)
        faces = index.ravel()[faces]
        a, b, c = faces.T
        return distinct, faces[(a != b) & (b != c) & (c != a)]

    def curvature(self, points: Array) -> tuple[Array, Array]:
        """Return k1, k2 (n, 2), |k1| >= |k2|, convex positive, and the direction of k1 (n, 3) at points (n, 3)."""
        axes = STEP * np.eye(3)
        gradient = np.stack([self.level(points + e) - self.level(points - e) for e in axes], axis=1) / (2 * STEP)
        hessian = np.empty((len(points), 3, 3))
        for i, e in enumerate(axes):
            for j, d in enumerate(axes):
                corners = self.level(points + e + d) - self.level(points + e - d)
                corners += self.level(points - e - d) - self.level(points - e + d)
                hessian[:, i, j] = corners / (4 * STEP**2)
        length = np.linalg.norm(gradient, axis=1)[:, None, None]
        normal = gradient / length[:, :, 0]
        tangential = np.eye(3) - normal[:, :, None] * normal[:, None, :]
        values, vectors = np.linalg.eigh(tangential @ (hessian / length) @ tangential)
        # The normal is an eigenvector too: its value is left out, whatever the order.
        along_normal = abs(np.einsum("nci,nc->ni", vectors, normal))
        order = np.argsort(np.where(along_normal > 0.9, 0, -abs(values) - 1e-9), axis=1)[:, :2]
        direction1 = np.take_along_axis(vectors, order[:, None, :1], axis=2)[:, :, 0]
        return np.take_along_axis(values, order, axis=1), direction1


def _grid(steps: tuple[int, int], sizes: tuple[int, int]) -> NDArray[np.int64]:
    i, j = (each.ravel() for each in np.meshgrid(*map(np.arange, steps), indexing="ij"))
    k, m = (i + 1) % sizes[0], (j + 1) % sizes[1]
    a, b, c, d = i * sizes[1] + j, k * sizes[1] + j, k * sizes[1] + m, i * sizes[1] + m
    return np.vstack([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def _capped(vertices: Array, faces: NDArray[np.int64], steps: tuple[int, int]) -> Mesh:
    around, last = np.arange(steps[0]), steps[1]
    low, high = around * (last + 1), around * (last + 1) + last
    bottom, top = len(vertices), len(vertices) + 1
    fans = [
        np.stack([np.roll(low, -1), low, np.full(steps[0], bottom)], axis=1),
        np.stack([high, np.roll(high, -1), np.full(steps[0], top)], axis=1),
    ]
    return np.vstack([vertices, vertices[low].mean(axis=0), vertices[high].mean(axis=0)]), np.vstack([faces, *fans])


def _xyz(*columns: Array) -> Array:
    return np.stack(np.broadcast_arrays(*columns), axis=1)


def _on_torus(u: Array, v: Array) -> Array:
    away = 1 + 0.4 * np.cos(TAU * v)
    return _xyz(away * np.cos(TAU * u), away * np.sin(TAU * u), 0.4 * np.sin(TAU * v))


def _on_ellipsoid(u: Array, v: Array) -> Array:
    ring = np.sin(np.pi * v)
    return _xyz(ring * np.cos(TAU * u), 0.6 * ring * np.sin(TAU * u), -0.4 * np.cos(np.pi * v))


TORUS = Analytic(
    lambda p: (np.hypot(p[:, 0], p[:, 1]) - 1) ** 2 + p[:, 2] ** 2 - 0.16,
    _on_torus,
    regular=(240, 96),
    needles=(96, 400),
    wraps=(True, True),
)
ELLIPSOID = Analytic(
    lambda p: ((p / [1, 0.6, 0.4]) ** 2).sum(axis=1) - 1,
    _on_ellipsoid,
    regular=(200, 100),
    needles=(800, 64),
    wraps=(True, False),
)
CYLINDER = Analytic(
    lambda p: p[:, 0] ** 2 + p[:, 1] ** 2 - 0.25,
    lambda u, v: _xyz(0.5 * np.cos(TAU * u), 0.5 * np.sin(TAU * u), 2 * v),
    regular=(120, 80),
    needles=(120, 1),
    wraps=(True, False),
    capped=True,
)
SADDLE = Analytic(
    lambda p: p[:, 2] - 0.5 * (p[:, 0] ** 2 - 0.6 * p[:, 1] ** 2),
    lambda u, v: _xyz(2 * u - 1, 2 * v - 1, 0.5 * ((2 * u - 1) ** 2 - 0.6 * (2 * v - 1) ** 2)),
    regular=(120, 120),
    needles=(90, 450),
)
WAVES = Analytic(
    lambda p: p[:, 2] - 0.2 * np.sin(4 * p[:, 0]),
    lambda u, v: _xyz(3 * u, 2 * v, 0.2 * np.sin(12 * u)),
    regular=(180, 100),
    needles=(180, 1),
)
SURFACES = {"torus": TORUS, "ellipsoid": ELLIPSOID, "cylinder": CYLINDER, "saddle": SADDLE, "waves": WAVES}
