# SPDX-License-Identifier: GPL-3.0-or-later
"""Patches of a cloud: the nearest points of some, and how far they lie off the planes and quadrics that fit them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

PLANE, QUADRIC = 3, 6
"""Unknowns of a plane, and of a quadratic surface over it."""


@dataclass(frozen=True)
class Patches:
    """The k nearest points of each of m places, in the frame of their plane; lengths count in its radius.

    Attributes
    ----------
    heights
        (m, k): above the plane, the nearest first.
    design
        (m, k, 6): what a quadric is a combination of; the first three make a plane.
    radii
        (m,) how far the farthest is from the place, in the unit of the points.
    normals
        (m, 3) of the plane, unit.
    """

    heights: NDArray[np.float64]
    design: NDArray[np.float64]
    radii: NDArray[np.float64]
    normals: NDArray[np.float64]

    @classmethod
    def around(cls, points: NDArray[np.float64], rows: NDArray[np.int64], count: int) -> Patches:
        """Take the `count` points nearest to those of the `rows` (m,) of points (n, 3), themselves included."""
        around = points[_core.nearest_neighbors(points, np.ascontiguousarray(points[rows]), count)]
        offsets = around - around.mean(axis=1, keepdims=True)
        radii = np.linalg.norm(around - points[rows, None], axis=2).max(axis=1)
        # Points that are distinct in the world may be equal in the unit frame: those lie on any plane.
        radii = np.where(radii > 0, radii, 1.0)
        _, frames = np.linalg.eigh(offsets.swapaxes(1, 2) @ offsets)
        height, u, v = np.moveaxis((offsets @ frames) / radii[:, None, None], 2, 0)
        design = np.stack([np.ones_like(u), u, v, u * u, u * v, v * v], axis=2)
        return cls(height, design, radii, frames[:, :, 0])

    @property
    def spacings(self) -> NDArray[np.float64]:
        """How far apart the points of each patch are, (m,): the side of the square of surface that one has."""
        # A disk that reaches to the k-th neighbour holds k points.
        return np.asarray(self.radii * np.sqrt(np.pi / self.heights.shape[1]))

    def residuals(self, unknowns: int) -> NDArray[np.float64]:
        """Return the residuals (m, k) of the heights after a least-squares fit of so many `unknowns`."""
        design = self.design[:, :, :unknowns]
        # By the pseudo-inverse: neighbours on a line do not determine the surface, and leave no residual.
        return np.asarray(self.heights - (design @ (np.linalg.pinv(design) @ self.heights[:, :, None]))[:, :, 0])


def deviation(residuals: NDArray[np.float64], unknowns: int) -> NDArray[np.float64]:
    """Return the standard deviation (m,) of the residuals (m, k) of a fit of so many unknowns; never quite 0."""
    squares = np.square(residuals).sum(axis=1)
    return np.asarray(np.sqrt(np.maximum(squares / (residuals.shape[1] - unknowns), np.finfo(np.float64).tiny)))
