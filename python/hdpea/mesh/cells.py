# SPDX-License-Identifier: GPL-3.0-or-later
"""Restricted Voronoi cells of particles, cut on tangent disks in R^d."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.tensors import symmetric_tensors
from hdpea.runtime.blocks import in_blocks

CELL_NEIGHBORS = 40
"""Nearest particles whose bisectors cut a cell: enough for disks of up to two mean distances."""


PLANE_NEIGHBORS = 7
"""Nearest particles that a particle's plane is fitted to: those of its cell in an even spread, and one more."""

SPARSE_NEIGHBOR = 2
"""Index of the neighbour whose distance widens a disk where it exceeds the mean spacing: the third, which particles at
a border also have."""

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
    offsets = coordinates[neighbors[:, :PLANE_NEIGHBORS]] - coordinates[:, None]
    distances = np.linalg.norm(offsets, axis=2)
    radii = disk_radius * np.maximum(distances[:, 0].mean(), distances[:, SPARSE_NEIGHBOR])
    faint = 1e-3 * float((distances**2).mean())
    planes = in_blocks(lambda rows: _planes(offsets[rows], distances[rows], bases[rows], faint), len(coordinates))
    flat_bases = planes.reshape(len(coordinates), -1)
    return _core.restricted_voronoi_candidates(coordinates, flat_bases, neighbors, radii), radii


def _planes(
    offsets: NDArray[np.float64], distances: NDArray[np.float64], bases: NDArray[np.float64], faint: float
) -> NDArray[np.float64]:
    """Return orthonormal bases (m, 2, d) of the planes of the `offsets` (m, k, d) to the neighbours, by PCA.

    Weights fall with the distance, so that an eighth neighbour as near as the seventh makes little difference; the
    cloud's own planes, `bases` (m, 2, d), have a `faint` one, and stand in where no neighbour is of the same sheet.
    """
    squared = distances**2
    in_plane = np.einsum("mbi,mki->mkb", bases, offsets)
    same_sheet = (in_plane**2).sum(axis=2) >= (1 - MAX_SLOPE**2) * squared
    # Where points lie in heaps, seven particles may be in one place.
    means = np.maximum(squared.mean(axis=1, keepdims=True), np.finfo(float).tiny)
    weights = np.exp(-squared / means) * same_sheet
    covariances = symmetric_tensors(weights, offsets)
    covariances += faint * np.einsum("mbi,mbj->mij", bases, bases)
    vectors = np.linalg.eigh(covariances).eigenvectors
    return np.ascontiguousarray(vectors[:, :, -2:].swapaxes(1, 2))
