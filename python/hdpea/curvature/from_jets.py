# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature from jets: quadratic fits to the points themselves, with the sign of the curvatures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.curvature.options import JET_NEIGHBORS, MOST_JET_NEIGHBORS
from hdpea.curvature.tensors import Estimate
from hdpea.geometry.metric import Metric
from hdpea.options.choice import Choice
from hdpea.surface.surface import Surface

SURE = 0.1
"""Standard error of the directions, in radians, up to which they are determined, and a jet needs no more neighbours.

With 1.5 times this, 5 % of the points of a noisy plane would get directions."""

SURELY_FLAT = 0.25
"""Standard error of the curvatures, in 1 / unit length, at which it needs no more either: less looks flat."""

FEW_UNSURE = 0.05
"""Share of unsure points that a clean cloud may have, at creases; with more, it is noisy."""

ROUND = 0.05
"""Difference of the curvatures, as a share of the larger, up to which a point counts as umbilic."""

FLAT = 0.05
"""The same in 1 / unit length: a radius of twenty diagonals."""


def estimate_from_jets(surface: Surface, metric: Metric, neighbors: int | None) -> Estimate:
    """Fit jets to each point and its neighbours of the same sheet, to more of them where noise needs it.

    The stretches are those of the `metric` for these curvatures.
    """
    jets, around = _fit(surface, neighbors)
    curvatures, direction1 = jets.curvature.principal, jets.curvature.direction1
    bend = _bend(jets)
    least_bend = np.maximum(ROUND * abs(curvatures[:, 0]), FLAT)
    # Comparisons with NaN are false: what is unknown is not determined.
    determined: NDArray[np.bool_] = (bend >= least_bend) & (jets.curvature_error <= SURE * bend)
    radius = _radius(surface.points_in_unit, around, jets.fitted) * surface.frame.diagonal
    choices: tuple[Choice, ...] = (
        Choice("jet_radius", radius, "world units", "to the farthest point that a jet is fitted to: the median"),
    )
    if neighbors is None:
        many = float((jets.fitted > JET_NEIGHBORS).mean())
        why = f"{JET_NEIGHBORS} where that is sure enough; {many:.0%} of the points have more"
        choices += (Choice("neighbors", float(jets.fitted.mean()), "points on average", why),)
    return Estimate(jets.normals, direction1, metric.stretches(curvatures), curvatures, determined, choices)


def _fit(surface: Surface, neighbors: int | None) -> tuple[_core.Jets, NDArray[np.int64]]:
    """Return the jets, and the neighbours (n, k) of which they are fitted to the first."""
    options = _core.JetOptions()
    points, normals = surface.points_in_unit, surface.normals
    if neighbors is not None:
        options.least_neighbors = neighbors
        nearest = _nearest(surface, neighbors)
        return _core.fit_jets(points, normals, nearest, options), nearest
    options.least_neighbors = JET_NEIGHBORS
    options.direction_error, options.curvature_error = SURE, SURELY_FLAT
    jets = _core.fit_jets(points, normals, surface.neighbors, options)
    unsure = jets.curvature_error > np.maximum(SURELY_FLAT, SURE * _bend(jets))
    if unsure.mean() <= FEW_UNSURE:
        return jets, surface.neighbors
    nearest = _nearest(surface, MOST_JET_NEIGHBORS)
    return _core.fit_jets(points, normals, nearest, options), nearest


def _radius(points: NDArray[np.float64], neighbors: NDArray[np.int64], fitted: NDArray[np.int64]) -> float:
    """Return the median distance to the last of the neighbours that each jet is fitted to; NaN if no jet has any."""
    rows = np.flatnonzero(fitted > 0)
    farthest = neighbors[rows, np.minimum(fitted[rows], neighbors.shape[1]) - 1]
    known = farthest >= 0
    distances = np.linalg.norm(points[farthest[known]] - points[rows[known]], axis=1)
    return float(np.median(distances)) if len(distances) else np.nan


def _bend(jets: _core.Jets) -> NDArray[np.float64]:
    """Return the difference (n,) of the curvatures."""
    bend: NDArray[np.float64] = abs(jets.curvature.principal[:, 0] - jets.curvature.principal[:, 1])
    return bend


def _nearest(surface: Surface, count: int) -> NDArray[np.int64]:
    if count <= surface.neighbors.shape[1]:
        return np.ascontiguousarray(surface.neighbors[:, :count])
    nearest = _core.nearest_neighbors(surface.points_in_unit, min(count, len(surface.points_in_unit) - 1))
    return _core.sheet_neighbors(surface.points_in_unit, surface.normals, nearest)
