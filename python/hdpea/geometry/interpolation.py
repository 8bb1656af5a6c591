# SPDX-License-Identifier: GPL-3.0-or-later
"""Values at points of a surface from those at other points of it, by local affine fits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

Rows = NDArray[np.float64]

NEAREST = 8
"""Nearest points that an affine map is fitted to."""

ACROSS = 4.0
"""Factor on distances across the surface, beside those along it: the far side of a thin wall counts as distant."""

AGREEING_COSINE = 0.5
"""Least cosine with the normal of the fit: points beyond a crease of more than 60 degrees are left out."""

RIDGE = 1e-2
"""Added to the mean squared tangent coordinates, as a share of them: neighbours on a line do not determine a map, and
a point outside of all its neighbours takes about their mean."""


@dataclass(frozen=True)
class Interpolation:
    """Values at m points from those at n others: weighted sums that reproduce what is affine along the surface.

    Attributes
    ----------
    members
        (m, k) int64: which of the n points, nearest first.
    weights
        (m, k) float64, summing to 1; NaN where no member is known.
    """

    members: NDArray[np.int64]
    weights: Rows

    @classmethod
    def of(
        cls,
        points: Rows,
        normals: Rows,
        others: Rows,
        other_normals: Rows | None = None,
        known: NDArray[np.bool_] | None = None,
    ) -> Interpolation:
        """Fit to those of the nearest points that lie on the same sheet and are known.

        Parameters
        ----------
        points, normals
            (n, 3), the normals unit and consistently oriented.
        others, other_normals
            (m, 3): where values are wanted. Where the normals are missing or agree with no neighbour, the sheet is that
            of the nearest point.
        known
            (n,): where there are values; default: everywhere.
        """
        members = _core.nearest_neighbors(points, others, min(NEAREST, len(points)))
        squared, along = np.empty(members.shape), np.empty((*members.shape, 3))
        for each, member in enumerate(members.T):
            offset = points[member] - others
            across = np.einsum("mc,mc->m", offset, normals[member])
            squared[:, each] = np.einsum("mc,mc->m", offset, offset) + ACROSS**2 * across**2
            along[:, each] = offset
        nearest = np.take_along_axis(members, squared.argmin(axis=1)[:, None], axis=1)[:, 0]
        fit_normals = normals[nearest]
        if other_normals is not None:
            usable = _agree(other_normals, normals[members]).any(axis=1, keepdims=True)
            fit_normals = np.where(usable, other_normals, fit_normals)
        weights = np.exp(-2 * squared / squared.max(axis=1, keepdims=True).clip(min=1e-300))
        weights *= _agree(fit_normals, normals[members])
        if known is not None:
            weights *= known[members]
        return cls(members, _affine_weights(weights, along, fit_normals))

    def __call__(self, values: Rows) -> Rows:
        """Return values (m, c), of values (n, c) that are not NaN where they are known."""
        total = np.zeros((len(self.members), values.shape[1]))
        for member, weights in zip(self.members.T, self.weights.T, strict=True):
            total += weights[:, None] * np.nan_to_num(values)[member]
        return total


def _agree(normals: Rows, of_members: Rows) -> NDArray[np.bool_]:
    """Return which members (m, k) have about the normals (m, 3)."""
    agree: NDArray[np.bool_] = np.einsum("mc,mkc->mk", normals, of_members) >= AGREEING_COSINE
    return agree


def _affine_weights(weights: Rows, offsets: Rows, normals: Rows) -> Rows:
    """Return the weights (m, k) of members in the intercept of their weighted least-squares fit.

    It is solved by blocks: with m the mean of the tangent coordinates u and S their mean squares, a member's weight is
    multiplied by 1 - m S^-1 u.
    """
    bases = _core.tangent_bases_across(normals).reshape(-1, 2, 3)
    with np.errstate(invalid="ignore"):
        share = weights / weights.sum(axis=1, keepdims=True)
    u = offsets @ bases.swapaxes(1, 2)
    squares = u.swapaxes(1, 2) @ (share[:, :, None] * u)
    squares += (RIDGE * np.trace(squares, axis1=1, axis2=2) + 1e-300)[:, None, None] * np.eye(2)
    slope = np.linalg.solve(squares, u.swapaxes(1, 2) @ share[:, :, None])
    affine = share * (1 - (u @ slope)[:, :, 0])
    return np.asarray(affine / affine.sum(axis=1, keepdims=True))
