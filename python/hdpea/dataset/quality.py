# SPDX-License-Identifier: GPL-3.0-or-later
"""Quality of the embedding of a sample: its deviation from isometry, and its roughness."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.dataset.options import GroundTruthOptions
from hdpea.dataset.sample import Sample
from hdpea.errors import core_errors_translated
from hdpea.geometry.tensors import symmetric_tensors, tangent_directions
from hdpea.surface.surface import area_shown

Rows = NDArray[np.float64]

NEIGHBORS = 12
"""Nearest points of the same sheet to which lengths are measured, as many as in the HD-PEA paper, appendix B."""


def neighbors_of(sample: Sample) -> NDArray[np.int64]:
    """Return the nearest points (n, 12) of the same sheet as each, padded with -1, without noise."""
    points, normals = sample.surface_points.astype(np.float64), sample.normals.astype(np.float64)
    with core_errors_translated():
        return _core.sheet_neighbors(points, normals, _core.nearest_neighbors(points, NEIGHBORS))


def spacing_of(sample: Sample, options: GroundTruthOptions) -> float:
    """Return sqrt(area / vertices) in the unit frame, the unit of the lengths in `options`.

    The area is estimated from the points, to within a few percent, since a sample does not contain its mesh.
    """
    area = area_shown(sample.surface_points.astype(np.float64), neighbors_of(sample))
    return float(np.sqrt(area / options.vertices))


def stretches(curvatures: NDArray[np.float32], options: GroundTruthOptions, spacing: float) -> Rows:
    """Return the stretch of the metric along the principal directions (n, 2): sqrt(clamp(c |k|, 1, s_max^2)).

    Parameters
    ----------
    curvatures
        (n, 2), in 1 / unit length.
    spacing
        The unit of the lengths in `options`, in unit length.
    """
    return options.metric.at(spacing).stretches(curvatures)


def isometry_errors(sample: Sample, options: GroundTruthOptions, spacing: float) -> Rows:
    """Return the relative errors (n,) of distances in R^8 to the neighbours, against those of the metric.

    The length under the metric is sqrt(dx^T M dx), with the mean M of both ends; the error is the root mean square
    over the neighbours of the ratio minus 1: 0 where the embedding is isometric, or there are no neighbours.
    """
    neighbors = neighbors_of(sample)
    offsets, known = _offsets(sample.surface_points.astype(np.float64), neighbors)
    embedded, _ = _offsets(sample.embedding.astype(np.float64), neighbors)
    metric = _metric(sample, stretches(sample.curvatures, options, spacing))
    between = (metric[:, None] + metric[neighbors]) / 2
    wanted = np.sqrt(np.einsum("nki,nkij,nkj->nk", offsets, between, offsets))
    apart = known & (wanted > 0)  # points may coincide
    ratios = np.linalg.norm(embedded, axis=2) / np.where(apart, wanted, 1)
    squares = np.where(apart, (ratios - 1) ** 2, 0).sum(axis=1)
    return np.asarray(np.sqrt(squares / np.maximum(apart.sum(axis=1), 1)))


def roughness(sample: Sample) -> Rows:
    """Return the distances (n,) of neighbours to their best plane in R^8, over their extent.

    The ratio (n,) is of root mean squares: 0 where the embedding is flat, above one half where psi is noise; where
    the embedding is smooth, it falls with the density of the points.
    """
    neighbors = neighbors_of(sample)
    offsets, known = _offsets(sample.embedding.astype(np.float64), neighbors)
    counts = np.maximum(known.sum(axis=1), 1)[:, None, None]
    centred = np.where(known[:, :, None], offsets - offsets.sum(axis=1, keepdims=True) / counts, 0)
    spread = np.linalg.eigvalsh(np.einsum("nki,nkj->nij", centred, centred)).clip(0)
    total = spread.sum(axis=1)
    return np.asarray(np.sqrt(spread[:, :-2].sum(axis=1) / np.where(total > 0, total, 1)))


def _offsets(rows: Rows, neighbors: NDArray[np.int64]) -> tuple[Rows, NDArray[np.bool_]]:
    """Return the offsets (n, k, d) of the neighbours, 0 where there is none, and the mask (n, k) of neighbours."""
    known = neighbors >= 0
    return np.where(known[:, :, None], rows[neighbors] - rows[:, None], 0), known


def _metric(sample: Sample, stretch: Rows) -> Rows:
    """Return M (n, 3, 3), the identity along the normals."""
    direction1 = sample.direction1.astype(np.float64)
    directions = tangent_directions(sample.normals.astype(np.float64), direction1)
    return np.asarray(np.eye(3) + symmetric_tensors(stretch**2 - 1, directions))
