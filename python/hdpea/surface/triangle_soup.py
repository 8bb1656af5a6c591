# SPDX-License-Identifier: GPL-3.0-or-later
"""A soup of triangles that stands in for a mesh wherever a surface is integrated over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core


@dataclass(frozen=True)
class Soup:
    """Tangential Delaunay triangles of all points: not a mesh, but every part of the surface is covered once.

    Attributes
    ----------
    triangles
        (t, 3) int64.
    weights
        (t,) float64: the share of each triangle, a third for every one of its corners whose cell has it.
    area
        Of the surface.
    """

    triangles: NDArray[np.int64]
    weights: NDArray[np.float64]
    area: float


def triangle_soup(points: NDArray[np.float64], normals: NDArray[np.float64], neighbors: NDArray[np.int64]) -> Soup:
    """Return the restricted Delaunay triangles of points in R^3, those of single cells (T1, T2) included.

    Parameters
    ----------
    points, normals
        (n, 3), the normals unit and consistently oriented.
    neighbors
        (n, k): nearest points of the same sheet, nearest first, -1 pads; k at least 8.
    """
    planes = _core.tangent_bases_across(_core.blended_normals(normals, neighbors))
    # Twice the distance of the 8th neighbour holds the cell, however uneven the sampling.
    first, eighth = (_distances(points, neighbors[:, each]) for each in (0, 7))
    radii = 2 * np.fmax(eighth, np.nanmedian(first))
    candidates = _core.restricted_voronoi_candidates(points, planes, neighbors, radii)
    return Soup(candidates.triangles, candidates.counts / 3, float(candidates.cell_areas.sum()))


def _distances(points: NDArray[np.float64], neighbor: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the distance (n,) of points to a neighbour (n,) of each; NaN where there is none."""
    distances: NDArray[np.float64] = np.linalg.norm(points[neighbor] - points, axis=1)
    distances[neighbor < 0] = np.nan
    return distances
