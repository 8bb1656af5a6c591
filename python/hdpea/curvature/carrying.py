# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors carried over from a thinned cloud to all of its points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.curvature.tensors import Estimate
from hdpea.geometry.metric import Metric

Rows = NDArray[np.float64]

CARRY_NEAREST = 8
"""Nearest points of the thinned cloud that an affine map is fitted to."""

ACROSS = 4.0
"""How much more a way across the surface counts than one along it: the other side of a thin wall is far."""

AGREEING_COSINE = 0.5
"""Least cosine with the nearest one's normal: beyond a crease of 60 degrees, a tensor has no say."""

RIDGE = 1e-2
"""Added to the squared tangent coordinates, as a share: neighbours on a line leave the map open, and an outlier, which
has them all to one side, takes about their mean."""

MOSTLY = 0.5
"""Share of the weights from which directions are determined where those of the tensors around are."""


@dataclass(frozen=True)
class Interpolation:
    """Values at m points from those at n others: weighted sums that leave what is affine on the surface alone.

    Attributes
    ----------
    members
        (m, k) int64: which of the n points.
    weights
        (m, k) float64, summing to 1; NaN where no member is known.
    """

    members: NDArray[np.int64]
    weights: Rows

    @classmethod
    def of(cls, points: Rows, normals: Rows, known: NDArray[np.bool_], others: Rows) -> Interpolation:
        """Fit to those nearest of points (n, 3), with unit normals (n, 3), that are `known` (n,) and of one sheet."""
        members = _core.nearest_neighbors(points, others, min(CARRY_NEAREST, len(points)))
        squared, along = np.empty(members.shape), np.empty((*members.shape, 3))
        for each, member in enumerate(members.T):
            way = points[member] - others
            across = np.einsum("mc,mc->m", way, normals[member])
            squared[:, each] = np.einsum("mc,mc->m", way, way) + ACROSS**2 * across**2
            along[:, each] = way
        nearest = np.take_along_axis(members, squared.argmin(axis=1)[:, None], axis=1)[:, 0]
        agree = np.einsum("mc,mkc->mk", normals[nearest], normals[members]) >= AGREEING_COSINE
        weights = np.exp(-2 * squared / squared.max(axis=1, keepdims=True).clip(min=1e-300))
        weights *= agree & known[members]
        return cls(members, _affine(weights, along, normals[nearest]))

    def __call__(self, values: Rows) -> Rows:
        """Return values (m, c), of values (n, c) that are not NaN where `known`."""
        total = np.zeros((len(self.members), values.shape[1]))
        for member, weights in zip(self.members.T, self.weights.T, strict=True):
            total += weights[:, None] * np.nan_to_num(values)[member]
        return total


def _affine(weights: Rows, ways: Rows, normals: Rows) -> Rows:
    """Return the weights (m, k) of members in the intercept of their weighted least-squares fit.

    Solved for by blocks: with m the mean tangent coordinates and S their mean squares, 1 - m S^-1 u times the weight.
    """
    bases = _core.tangent_bases_across(normals).reshape(-1, 2, 3)
    with np.errstate(invalid="ignore"):
        share = weights / weights.sum(axis=1, keepdims=True)
    u = ways @ bases.swapaxes(1, 2)
    squares = u.swapaxes(1, 2) @ (share[:, :, None] * u)
    squares += (RIDGE * np.trace(squares, axis1=1, axis2=2) + 1e-300)[:, None, None] * np.eye(2)
    slope = np.linalg.solve(squares, u.swapaxes(1, 2) @ share[:, :, None])
    affine = share * (1 - (u @ slope)[:, :, 0])
    return np.asarray(affine / affine.sum(axis=1, keepdims=True))


def carried_over(points: Rows, estimate: Estimate, metric: Metric | None, signed: bool, others: Rows) -> Estimate:
    """Return the estimate at other points of the surface: that of the nearest, along an affine fit to their tensors.

    The tensors are those of curvature if it is `signed`, else those of the metric, which says the same.

    Parameters
    ----------
    points, estimate
        The thinned cloud (n, 3), and what is known of it.
    metric
        Of the stretches; without it curvatures are not known.
    others
        (m, 3).
    """
    interpolated = Interpolation.of(points, estimate.normals, np.isfinite(estimate.stretches[:, 0]), others)
    nearest_normals = estimate.normals[interpolated.members[:, 0]]
    normals = np.where(np.isfinite(interpolated.weights[:, :1]), interpolated(estimate.normals), nearest_normals)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    principal = estimate.curvatures if signed else estimate.stretches**2
    second = np.cross(estimate.normals, estimate.direction1)
    tensors = sum(
        principal[:, [which]] * (direction[:, :, None] * direction[:, None, :]).reshape(-1, 9)
        for which, direction in enumerate((estimate.direction1, second))
    )
    principal, direction1 = _in_tangent_planes(interpolated(np.asarray(tensors)).reshape(-1, 3, 3), normals)
    if signed and metric is not None:
        curvatures, stretches = principal, metric.stretches(principal)
    else:
        stretches = np.sqrt(principal.clip(min=1))
        curvatures = np.full_like(stretches, np.nan) if metric is None else metric.curvatures(stretches)
    determined = interpolated(estimate.determined[:, None].astype(np.float64))[:, 0] >= MOSTLY
    return Estimate(normals, direction1, stretches, curvatures, determined, estimate.choices)


def _in_tangent_planes(tensors: Rows, normals: Rows) -> tuple[Rows, Rows]:
    """Return k1, k2 (m, 2), |k1| >= |k2|, and the direction of k1 (m, 3) of symmetric tensors (m, 3, 3)."""
    bases = _core.tangent_bases_across(normals).reshape(-1, 2, 3)
    inside = bases @ tensors @ bases.swapaxes(1, 2)
    middle, half = (inside[:, 0, 0] + inside[:, 1, 1]) / 2, (inside[:, 0, 0] - inside[:, 1, 1]) / 2
    reach = np.hypot(half, inside[:, 0, 1])
    side = np.where(middle < 0, -1, 1)
    angle = (np.arctan2(inside[:, 0, 1], half) + np.where(middle < 0, np.pi, 0)) / 2
    direction1 = np.cos(angle)[:, None] * bases[:, 0] + np.sin(angle)[:, None] * bases[:, 1]
    return np.stack([middle + side * reach, middle - side * reach], axis=1), direction1
