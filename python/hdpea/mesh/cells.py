# SPDX-License-Identifier: GPL-3.0-or-later
"""Restricted Voronoi cells of particles, cut on tangent disks in R^d."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.tensors import symmetric_tensors
from hdpea.geometry.thinning import rows_along

CELL_NEIGHBORS = 40
"""Nearest particles whose bisectors cut a cell: enough for disks of up to two mean distances."""


PLANE_NEIGHBORS = 7
"""Nearest particles that a particle's plane is fitted to: those of its cell in an even spread, and one more."""

SPARSE_NEIGHBOR = 2
"""Index of the neighbour whose distance widens a disk where it exceeds the mean spacing: the third, which particles at
a border also have."""

CELLS_MEASURED = 4_000
"""Most cells of which the mean area is taken: their areas vary by a fifth, so it is certain to a third of a percent."""

MAX_SLOPE = 0.95
"""Sine of the largest angle between a neighbour's direction and the cloud's plane: beyond it lies another sheet."""


def restricted_cells(
    coordinates: NDArray[np.float64], bases: NDArray[np.float64], disk_radius: float
) -> tuple[_core.Candidates, NDArray[np.float64]]:
    """Return the triangles dual to the cells' corners with the cells' areas, and the disks' radii (m,) in R^d.

    Disks lie in the planes of the particles themselves, not of the cloud (HD-PEA, section 3.3): where the surface
    bends within a cell, as on thin struts, those of neighbours agree better, and so do their cells. Where the points
    are too few for the stretch of the embedding, particles lie farther apart than on average; there the disks are
    wider, or they would not meet.

    Parameters
    ----------
    coordinates
        (m, d) float64.
    bases
        (m, 2, d) float64, orthonormal: the cloud's tangent planes at the particles.
    disk_radius
        In mean distances of the particles to their nearest neighbours.
    """
    neighbors = _core.nearest_neighbors(coordinates, CELL_NEIGHBORS)
    planes, radii = _disks(coordinates, coordinates, neighbors, bases, disk_radius)
    return _core.restricted_voronoi_candidates(coordinates, planes, neighbors, radii), radii


def mean_cell_area(coordinates: NDArray[np.float64], bases: NDArray[np.float64], disk_radius: float) -> float:
    """Return the mean area of the cells that ``restricted_cells`` would make: of some of them, if there are many."""
    rows = rows_along(len(coordinates), CELLS_MEASURED)
    # The nearest to a particle is the particle itself, or one in its place.
    found = _core.nearest_neighbors(coordinates, coordinates[rows], CELL_NEIGHBORS + 1)[:, 1:]
    neighbors = np.full((len(coordinates), found.shape[1]), -1)
    planes, radii = bases.reshape(len(coordinates), -1).copy(), np.ones(len(coordinates))
    neighbors[rows] = found
    planes[rows], radii[rows] = _disks(coordinates, coordinates[rows], found, bases[rows], disk_radius)
    cells = _core.restricted_voronoi_candidates(coordinates, planes, neighbors, radii)
    return float(cells.cell_areas[rows].mean())


def _disks(
    coordinates: NDArray[np.float64],
    centres: NDArray[np.float64],
    neighbors: NDArray[np.int64],
    bases: NDArray[np.float64],
    disk_radius: float,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return flat bases (m, 2 d) of the disks at `centres` (m, d) among their neighbours (m, k), and radii (m,)."""
    offsets = coordinates[neighbors[:, :PLANE_NEIGHBORS]] - centres[:, None]
    distances = np.linalg.norm(offsets, axis=2)
    radii = disk_radius * np.maximum(distances[:, 0].mean(), distances[:, SPARSE_NEIGHBOR])
    return _planes(offsets, distances, bases).reshape(len(centres), -1), radii


def _planes(
    offsets: NDArray[np.float64], distances: NDArray[np.float64], bases: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return orthonormal bases (m, 2, d) of the planes of the `offsets` (m, k, d) to the neighbours, by PCA.

    Weights fall with the distance, so that an eighth neighbour as near as the seventh makes little difference; the
    cloud's own planes, `bases` (m, 2, d), have next to none, and stand in where no neighbour is of the same sheet.
    """
    squared = distances**2
    in_plane = np.einsum("mbi,mki->mkb", bases, offsets)
    same_sheet = (in_plane**2).sum(axis=2) >= (1 - MAX_SLOPE**2) * squared
    # Where points lie in heaps, seven particles may be in one place.
    means = np.maximum(squared.mean(axis=1, keepdims=True), np.finfo(float).tiny)
    weights = np.exp(-squared / means) * same_sheet
    covariances = symmetric_tensors(weights, offsets)
    covariances += 1e-3 * squared.mean() * np.einsum("mbi,mbj->mij", bases, bases)
    vectors = np.linalg.eigh(covariances).eigenvectors
    return np.ascontiguousarray(vectors[:, :, -2:].swapaxes(1, 2))
