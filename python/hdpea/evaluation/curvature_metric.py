# SPDX-License-Identifier: GPL-3.0-or-later
"""The curvature metric of the true surface, and how close to equilateral triangles are under it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.tensors import frames, symmetric_tensors
from hdpea.geometry.triangles import area_vectors_of

Rows = NDArray[np.float64]

SAMPLES = 30_000
"""Points of the surface at which curvature is estimated."""

SHARED_BY = 40
"""Mean number of samples within the radius of the curvature fit: that of a disk of 40 / 30,000 of the area."""

NEIGHBORS = 80
"""Nearest samples considered: enough to find all within the radius on the same sheet, even where another is near."""

LEAST_COSINE = -0.2
"""Smallest cosine between the normals of samples on the same sheet."""

FLAT = 1.0
"""Smallest curvature that the metric distinguishes, in 1 / longest side."""

MOST_STRETCHED = 10.0
"""Largest ratio of the metric's stretches."""


@dataclass(frozen=True)
class CurvatureMetric:
    """The square roots (n, 3, 3) of the metric tensors at points (n, 3) of a surface whose longest side is 1."""

    points: Rows
    roots: Rows

    def qualities(self, vertices: Rows, faces: NDArray[np.int64]) -> Rows:
        """Return G (f,) of triangles: 1 for those equilateral under the metric, 0 for those without area.

        Each triangle is mapped by the mean of the roots at its corners, taken from the nearest point of the surface.
        """
        nearest = _core.nearest_neighbors(self.points, vertices, 1)[:, 0]
        roots = self.roots[nearest][faces].mean(axis=1)
        offsets = vertices[faces] - vertices[faces[:, :1]]
        return triangle_qualities(np.einsum("fij,fkj->fki", roots, offsets))


def curvature_metric(points: Rows, normals: Rows, area: float) -> CurvatureMetric:
    """Return the metric M = |k1| e1 e1^T + |k2| (e2 e2^T + n n^T) at samples of a surface.

    The stretch along a principal direction is sqrt|k|, so that triangles equilateral under M are sqrt|k1 / k2| times
    as long as wide, which is L2-optimal (Simpson, 1994). |k| is raised to ``FLAT``, and to |k1| / ``MOST_STRETCHED``^2.

    Parameters
    ----------
    points, normals
        (n, 3), n > 0, approximately uniform by area; the longest side of the surface is 1.
    area
        Area of the surface.
    """
    # The radius depends on the area alone, whatever the number of samples and however the surface is triangulated.
    radius = float(np.sqrt(area * SHARED_BY / SAMPLES / np.pi))
    neighbors = _core.nearest_neighbors(points, min(NEIGHBORS, max(len(points) - 1, 1)))
    across = np.einsum("nkc,nc->nk", normals[neighbors], normals) <= LEAST_COSINE
    curvature = _core.estimate_curvature(points, normals, np.where(across, -1, neighbors), radius)
    return CurvatureMetric(points, root_metrics(normals, curvature.principal, curvature.direction1))


def root_metrics(normals: Rows, principal: Rows, direction1: Rows) -> Rows:
    """Return sqrt(M) (n, 3, 3) as in ``curvature_metric``; principal curvatures are (n, 2), |k1| >= |k2|.

    ``FLAT`` is in the units of the curvatures.
    """
    k1, k2 = np.maximum(abs(principal), FLAT).T
    k2 = np.maximum(k2, k1 / MOST_STRETCHED**2)
    roots = np.sqrt(np.stack([k1, k2, k2], axis=1))
    return symmetric_tensors(roots, frames(normals, direction1))


def triangle_qualities(corners: Rows) -> Rows:
    """Return 2 sqrt(3) S / (p h) (f,) of triangles (f, 3, 3): area, half perimeter, longest edge; 1 if equilateral.

    From Frey and Borouchaki, Surface mesh quality evaluation, 1999; the G of the HD-PEA paper, section 4.1.
    """
    edges = np.roll(corners, -1, axis=1) - corners
    lengths = np.linalg.norm(edges, axis=2)
    areas = np.linalg.norm(area_vectors_of(corners), axis=1)
    sizes = lengths.sum(axis=1) / 2 * lengths.max(axis=1)
    return np.asarray(2 * np.sqrt(3) * areas / np.where(sizes > 0, sizes, 1))
