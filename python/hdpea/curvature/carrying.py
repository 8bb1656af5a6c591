# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors carried over from a thinned cloud to all of its points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.curvature.tensors import Estimate
from hdpea.geometry.interpolation import Interpolation
from hdpea.geometry.metric import Metric
from hdpea.geometry.tensors import principal_in_planes, symmetric_tensors, tangent_directions

Rows = NDArray[np.float64]

MOSTLY = 0.5
"""Share of the weights from which directions are determined where those of the tensors around are."""


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
    known = np.isfinite(estimate.stretches[:, 0])
    interpolated = Interpolation.of(points, estimate.normals, others, known=known)
    nearest_normals = estimate.normals[interpolated.members[:, 0]]
    normals = np.where(np.isfinite(interpolated.weights[:, :1]), interpolated(estimate.normals), nearest_normals)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    principal = estimate.curvatures if signed else estimate.stretches**2
    tensors = symmetric_tensors(principal, tangent_directions(estimate.normals, estimate.direction1))
    principal, direction1 = principal_in_planes(interpolated(tensors.reshape(-1, 9)).reshape(-1, 3, 3), normals)
    if signed and metric is not None:
        curvatures, stretches = principal, metric.stretches(principal)
    else:
        stretches = np.sqrt(principal.clip(min=1))
        curvatures = np.full_like(stretches, np.nan) if metric is None else metric.curvatures(stretches)
    determined = interpolated(estimate.determined[:, None].astype(np.float64))[:, 0] >= MOSTLY
    return Estimate(normals, direction1, stretches, curvatures, determined, estimate.choices)
