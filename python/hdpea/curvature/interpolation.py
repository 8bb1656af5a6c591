# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors of a thinned cloud, interpolated at all of its points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.curvature.tensors import Estimate
from hdpea.geometry.interpolation import Interpolation
from hdpea.geometry.metric import Metric
from hdpea.geometry.tensors import principal_in_planes, symmetric_tensors, tangent_directions

Rows = NDArray[np.float64]

MOSTLY = 0.5
"""Least share of the weights, of points with determined directions, with which directions are determined."""


def interpolated_estimate(
    points: Rows, estimate: Estimate, metric: Metric | None, signed: bool, others: Rows
) -> Estimate:
    """Return the estimate at other points of the surface, by affine fits to the tensors of the nearest points.

    The tensors are those of curvature if it is `signed`, else those of the metric, from which curvature follows.

    Parameters
    ----------
    points, estimate
        The thinned cloud (n, 3), and its estimate.
    metric
        Of the stretches; without it curvatures are not known.
    others
        (m, 3).
    """
    known = np.isfinite(estimate.stretches[:, 0])
    interpolation = Interpolation.of(points, estimate.normals, others, known=known)
    nearest_normals = estimate.normals[interpolation.members[:, 0]]
    normals = np.where(np.isfinite(interpolation.weights[:, :1]), interpolation(estimate.normals), nearest_normals)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    principal = estimate.curvatures if signed else estimate.stretches**2
    tensors = symmetric_tensors(principal, tangent_directions(estimate.normals, estimate.direction1))
    principal, direction1 = principal_in_planes(interpolation(tensors.reshape(-1, 9)).reshape(-1, 3, 3), normals)
    if signed and metric is not None:
        curvatures, stretches = principal, metric.stretches(principal)
    else:
        stretches = np.sqrt(principal.clip(min=1))
        curvatures = np.full_like(stretches, np.nan) if metric is None else metric.curvatures(stretches)
    determined = interpolation(estimate.determined[:, None].astype(np.float64))[:, 0] >= MOSTLY
    return Estimate(normals, direction1, stretches, curvatures, determined, estimate.choices)
