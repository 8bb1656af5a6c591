# SPDX-License-Identifier: GPL-3.0-or-later
"""How far two surfaces are apart: between samples, as papers report it, and exactly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

Rows = NDArray[np.float64]


@dataclass(frozen=True)
class SampleDistances:
    """From each sample of one surface to the nearest sample of the other, both ways, and what their normals say.

    Attributes
    ----------
    from_truth, from_result
        (n,) and (m,).
    normal_consistency
        Mean |n . n'| of nearest samples, the mean of both ways; None where normals are unknown.
    """

    from_truth: Rows
    from_result: Rows
    normal_consistency: float | None

    def chamfer(self, unit: float) -> float:
        """Return the mean squared distance one way plus that the other way, in squares of `unit`."""
        return float(np.mean(self.from_truth**2) + np.mean(self.from_result**2)) / unit**2

    def f1(self, threshold: float) -> float:
        """Return the harmonic mean of the shares of samples, either way, that are nearer than `threshold`."""
        recall, precision = np.mean(self.from_truth < threshold), np.mean(self.from_result < threshold)
        return float(2 * precision * recall / (precision + recall)) if precision + recall > 0 else 0.0

    def hausdorff(self, unit: float) -> float:
        """Return the largest distance of either way, in `unit`."""
        return float(max(self.from_truth.max(), self.from_result.max())) / unit


def distances_between(
    truth: Rows, truth_normals: Rows | None, result: Rows, result_normals: Rows | None
) -> SampleDistances:
    """Compare samples (n, 3) of the truth with samples (m, 3) of the result; normals are unit, or 0 where unknown."""
    from_truth, nearest_to_truth = _to_nearest(result, truth)
    from_result, nearest_to_result = _to_nearest(truth, result)
    consistency = None
    if truth_normals is not None and result_normals is not None:
        ways = (
            _agreement(truth_normals, result_normals[nearest_to_truth]),
            _agreement(result_normals, truth_normals[nearest_to_result]),
        )
        consistency = float(np.mean(ways))
    return SampleDistances(from_truth, from_result, consistency)


def _to_nearest(points: Rows, queries: Rows) -> tuple[Rows, NDArray[np.int64]]:
    nearest = _core.nearest_neighbors(points, queries, 1)[:, 0]
    return np.linalg.norm(queries - points[nearest], axis=1), nearest


def _agreement(normals: Rows, others: Rows) -> float:
    known = normals.any(axis=1) & others.any(axis=1)
    return float(abs(np.einsum("nc,nc->n", normals, others))[known].mean()) if known.any() else 0.0


@dataclass(frozen=True)
class OneWay:
    """Exact distances from points of one surface to the other surface; ``max`` counts its vertices, too."""

    rms: float
    max: float

    def in_unit(self, unit: float) -> OneWay:
        """Return the same in `unit`."""
        return OneWay(self.rms / unit, self.max / unit)


def distances_to_surface(samples: Rows, corners: Rows, vertices: Rows, faces: NDArray[np.int64]) -> OneWay:
    """Return how far samples (n, 3) of one surface, and its vertices `corners` (c, 3), are from another surface.

    The largest distance of a mesh from a surface is often at a vertex, which samples only come near to.
    """
    distances = _core.closest_surface_points(vertices, faces, np.vstack([samples, corners])).distance
    return OneWay(float(np.sqrt(np.mean(distances[: len(samples)] ** 2))), float(distances.max()))
