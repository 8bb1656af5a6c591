# SPDX-License-Identifier: GPL-3.0-or-later
"""Restricted Voronoi cells of particles, cut on tangent disks in R^d."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

CELL_NEIGHBORS = 40
"""Nearest particles whose bisectors cut a cell: enough for disks of up to two mean distances."""


def restricted_cells(
    coordinates: NDArray[np.float64], bases: NDArray[np.float64], disk_radius: float
) -> tuple[_core.Candidates, float]:
    """Return the triangles dual to the cells' corners with the cells' areas, and the disks' radius in R^d.

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
    radius = disk_radius * float(np.linalg.norm(coordinates[neighbors[:, 0]] - coordinates, axis=1).mean())
    flat_bases = bases.reshape(len(coordinates), -1)
    radii = np.full(len(coordinates), radius)
    return _core.restricted_voronoi_candidates(coordinates, flat_bases, neighbors, radii), radius
