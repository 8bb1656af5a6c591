# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances between two surfaces: between samples of them, as papers report, and exact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

Rows = NDArray[np.float64]


@dataclass(frozen=True)
class SampleDistances:
    """Distances from each sample of either surface to the nearest of the other, and how well their normals agree.

    Attributes
    ----------
    from_truth, from_result
        (n,) from the samples of the truth, (m,) from those of the result.
    normal_consistency
        Mean |n . n'| over nearest samples, averaged over both directions; None where normals are unknown.
    """

    from_truth: Rows
    from_result: Rows
    normal_consistency: float | None

    def chamfer(self, unit: float) -> float:
        """Return the sum of the mean squared distances in both directions, in `unit` squared."""
        return float(np.mean(self.from_truth**2) + np.mean(self.from_result**2)) / unit**2

    def f1(self, threshold: float) -> float:
        """Return the harmonic mean of precision and recall: the shares of samples that are nearer than `threshold`."""
        recall, precision = np.mean(self.from_truth < threshold), np.mean(self.from_result < threshold)
        return float(2 * precision * recall / (precision + recall)) if precision + recall > 0 else 0.0

    def hausdorff(self, unit: float) -> float:
        """Return the largest distance in either direction, in `unit`."""
        return float(max(self.from_truth.max(), self.from_result.max())) / unit


def distances_between(
    truth: Rows, truth_normals: Rows | None, result: Rows, result_normals: Rows | None
) -> SampleDistances:
    """Compare samples (n, 3) of the truth with samples (m, 3) of the result; normals are unit, or 0 where unknown."""
    from_truth, nearest_to_truth = _to_nearest(result, truth)
    from_result, nearest_to_result = _to_nearest(truth, result)
    consistency = None
    if truth_normals is not None and result_normals is not None:
        agreements = (
            _agreement(truth_normals, result_normals[nearest_to_truth]),
            _agreement(result_normals, truth_normals[nearest_to_result]),
        )
        consistency = float(np.mean(agreements))
    return SampleDistances(from_truth, from_result, consistency)


def _to_nearest(points: Rows, queries: Rows) -> tuple[Rows, NDArray[np.int64]]:
    nearest = _core.nearest_neighbors(points, queries, 1)[:, 0]
    return np.linalg.norm(queries - points[nearest], axis=1), nearest


def _agreement(normals: Rows, others: Rows) -> float:
    known = normals.any(axis=1) & others.any(axis=1)
    return float(abs(np.einsum("nc,nc->n", normals, others))[known].mean()) if known.any() else 0.0


@dataclass(frozen=True)
class DirectedDistances:
    """Exact distances from points of one surface to the other surface; ``max`` includes the vertices of the first."""

    rms: float
    max: float

    def in_unit(self, unit: float) -> DirectedDistances:
        """Return the same distances in `unit`."""
        return DirectedDistances(self.rms / unit, self.max / unit)


def distances_to_surface(samples: Rows, corners: Rows, vertices: Rows, faces: NDArray[np.int64]) -> DirectedDistances:
    """Return the distances of samples (n, 3) of one surface, and of its vertices `corners` (c, 3), to another surface.

    The largest distance of a mesh to a surface is often at a vertex, which no sample hits exactly.
    """
    distances = _core.closest_surface_points(vertices, faces, np.vstack([samples, corners])).distance
    return DirectedDistances(float(np.sqrt(np.mean(distances[: len(samples)] ** 2))), float(distances.max()))
