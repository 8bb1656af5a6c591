# SPDX-License-Identifier: GPL-3.0-or-later
"""Restricted Voronoi cells of particles, cut on tangent disks in R^d."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

CELL_NEIGHBORS = 40
"""Nearest particles whose bisectors cut a cell: enough for disks of up to two mean distances."""


SPARSE_NEIGHBOR = 2
"""Index of the neighbour (the third) whose distance widens a disk where it is beyond the mean spacing."""


def restricted_cells(
    coordinates: NDArray[np.float64], bases: NDArray[np.float64], disk_radius: float
) -> tuple[_core.Candidates, NDArray[np.float64]]:
    """Return the triangles dual to the cells' corners with the cells' areas, and the disks' radii (m,) in R^d.

    Where the points are too few for the stretch of the embedding, particles lie farther apart than on average;
    there the disks are wider, or they would not meet.

    Parameters
    ----------
    coordinates
        (m, d) float64.
    bases
        (m, 2, d) float64, orthonormal.
    disk_radius
        In mean distances of the particles to their nearest neighbours.
    """
    neighbors = _core.nearest_neighbors(coordinates, CELL_NEIGHBORS)
    nearest, sparse = (
        np.linalg.norm(coordinates[neighbors[:, column]] - coordinates, axis=1) for column in (0, SPARSE_NEIGHBOR)
    )
    radii = disk_radius * np.maximum(sparse, nearest.mean())
    flat_bases = bases.reshape(len(coordinates), -1)
    return _core.restricted_voronoi_candidates(coordinates, flat_bases, neighbors, radii), radii
