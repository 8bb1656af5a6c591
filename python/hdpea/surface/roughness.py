# SPDX-License-Identifier: GPL-3.0-or-later
"""How rough a cloud is, told from the points alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

SAMPLES = 2_000
"""Points looked at: their median is sure to a few percent."""

NEIGHBORS = 24
"""Points that a quadratic surface, of six unknowns, is fitted to."""

CLEANEST = 0.25
"""Share of the points whose residual is below the one reported: creases are not noise, for they are not everywhere."""


SPREAD = 0.525
"""Half of what a plane leaves over of noise lies within so many standard deviations, and more: 0.54 to 0.55 measured.

Of two sheets, as of thin walls, it lies nearer to their two heights (``benchmarks/roughness_table.py``)."""

SATURATED, LEAST_SHARE = 0.94, 0.25
"""Deviation from a quadric, in spacings, that no noise exceeds, and the least share of the noise that it can be.

Seen by few neighbours a thick shell is a ball full of points. Corrected, noise of up to 1.5 spacings is told to 15 %.
"""


@dataclass(frozen=True)
class Roughness:
    """How far points are off a smooth surface, and of what kind that is.

    Attributes
    ----------
    deviation
        Standard deviation across the surface, in spacings of the points: the side of the square of surface that each
        has for itself. It is what quadratic surfaces leave over, so that curvature does not count.
    like_noise
        Whether it is spread like noise. The two sides of thin walls are not, nor are scans that do not quite meet.
    """

    deviation: float
    like_noise: bool

    @property
    def noise(self) -> float:
        """The deviation if it is noise, else 0."""
        return self.deviation if self.like_noise else 0.0

    def __str__(self) -> str:
        """Say how far, in spacings."""
        return f"the points are {self.deviation:.2g} spacings off a smooth surface"


def roughness_of(points: NDArray[np.float64]) -> Roughness:
    """Return how rough points (n, 3) are: not at all for under 24."""
    count = len(points)
    if count < NEIGHBORS:
        return Roughness(0.0, False)
    rows = np.linspace(0, count - 1, min(SAMPLES, count)).astype(np.int64)
    around = points[_core.nearest_neighbors(points, points[rows], NEIGHBORS)]
    ways = around - around.mean(axis=1, keepdims=True)
    radii = np.linalg.norm(around - points[rows, None], axis=2).max(axis=1)
    _, frames = np.linalg.eigh(ways.swapaxes(1, 2) @ ways)
    height, u, v = np.moveaxis((ways @ frames) / radii[:, None, None], 2, 0)
    plane = np.stack([np.ones_like(u), u, v], axis=2)
    left = _left_over(plane, height)
    spread = float(np.median(_shortest_half(left) / _deviation(left, plane.shape[2])))
    quadratic = np.concatenate([plane, np.stack([u * u, u * v, v * v], axis=2)], axis=2)
    deviations = _deviation(_left_over(quadratic, height), quadratic.shape[2]) * np.sqrt(NEIGHBORS / np.pi)
    seen = float(np.quantile(deviations, CLEANEST))
    return Roughness(seen / max(1 - (seen / SATURATED) ** 4, LEAST_SHARE), spread >= SPREAD)


def _left_over(design: NDArray[np.float64], height: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what is left of heights (m, k) by the least-squares fit of a design (m, k, c)."""
    # By the pseudo-inverse: neighbours on a line leave the surface open, and nothing over.
    left: NDArray[np.float64] = height - (design @ (np.linalg.pinv(design) @ height[:, :, None]))[:, :, 0]
    return left


def _deviation(left: NDArray[np.float64], unknowns: int) -> NDArray[np.float64]:
    """Return the standard deviation (m,) of what a fit of so many unknowns leaves over (m, k); never quite 0."""
    squares = np.square(left).sum(axis=1)
    return np.asarray(np.sqrt(np.maximum(squares / (left.shape[1] - unknowns), np.finfo(np.float64).tiny)))


def _shortest_half(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return half the length (m,) of the shortest interval that holds more than half of each row (m, k)."""
    ordered, most = np.sort(values, axis=1), values.shape[1] // 2
    return np.asarray((ordered[:, most:] - ordered[:, :-most]).min(axis=1) / 2)
