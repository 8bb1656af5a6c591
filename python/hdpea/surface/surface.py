# SPDX-License-Identifier: GPL-3.0-or-later
"""The oriented cloud in its unit frame, with neighbours along the surface: what every stage works on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import CannotReconstruct, core_errors_translated
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.runtime.blocks import in_blocks

NEIGHBORS = 40
"""Nearest points of each point that are searched for, once for all stages."""

AREA_NEIGHBORS = 12
"""Nearest points of the same sheet that an area is estimated from."""

MIN_POINTS = 16
"""Fewer points than this do not show a surface."""


@dataclass(frozen=True)
class Surface:
    """Samples of a surface.

    Attributes
    ----------
    frame
        Where the unit frame lies in the world.
    points_in_unit
        (n, 3) float64.
    normals
        (n, 3) float64, unit, consistently oriented.
    neighbors
        (n, 40) int64: nearest points of the same sheet, nearest first, padded with -1. Neighbours on the other
        side of a thin wall are left out, since they are near in space but not along the surface.
    spacing
        Median distance to the nearest neighbour, in the unit frame.
    """

    frame: UnitFrame
    points_in_unit: NDArray[np.float64]
    normals: NDArray[np.float64]
    neighbors: NDArray[np.int64]
    spacing: float

    @classmethod
    def of(
        cls,
        frame: UnitFrame,
        points_in_unit: NDArray[np.float64],
        normals: NDArray[np.float64],
        neighbors: NDArray[np.int64] | None = None,
    ) -> Surface:
        """Find the neighbours of oriented points; `neighbors` (n, k) saves the search if they are known."""
        with core_errors_translated():
            if neighbors is None:
                neighbors = _core.nearest_neighbors(points_in_unit, NEIGHBORS)
            along_surface = _core.sheet_neighbors(points_in_unit, normals, neighbors)
        return cls(frame, points_in_unit, normals, along_surface, median_spacing(points_in_unit, neighbors))


def median_spacing(points: NDArray[np.float64], neighbors: NDArray[np.int64]) -> float:
    """Return the median distance of points (n, 3) to the first of their `neighbors` (n, k)."""
    return float(np.median(np.linalg.norm(points[neighbors[:, 0]] - points, axis=1)))


def area_shown(points: NDArray[np.float64], neighbors: NDArray[np.int64]) -> float:
    """Return the area of the surface that points (n, 3) show, to some percent; `neighbors` (n, k) as in ``Surface``."""
    return float(areas_shown(points, neighbors).sum())


def areas_shown(points: NDArray[np.float64], neighbors: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the area (n,) of the surface that each of the points (n, 3) has for itself.

    It is estimated from the nearest ``AREA_NEIGHBORS``: the disk out to the k-th neighbour of a point holds the area
    of k points, at any density.
    """

    def areas(rows: slice) -> NDArray[np.float64]:
        near = neighbors[rows, :AREA_NEIGHBORS]
        known = near >= 0
        offsets = np.where(known[:, :, None], points[near] - points[rows, None], 0)
        squared_radii = np.einsum("nkc,nkc->nk", offsets, offsets).max(axis=1)
        return np.asarray(np.pi * squared_radii / np.maximum(known.sum(axis=1), 1))

    return in_blocks(areas, len(points))


def disk_radii(points: NDArray[np.float64], neighbors: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return how far (n,) each of the points (n, 3) shows the surface: to the last of its ``AREA_NEIGHBORS``.

    Of random points, hardly a place is farther than that from the nearest.
    """
    known = (neighbors[:, :AREA_NEIGHBORS] >= 0).sum(axis=1)
    return np.asarray(np.sqrt(areas_shown(points, neighbors) * known / np.pi))


def require_surface(points_in_unit: NDArray[np.float64]) -> None:
    """Refuse points (n, 3) that no surface can be made of.

    Raises
    ------
    CannotReconstruct
        If there are fewer than 16, or all lie on a line.
    """
    if len(points_in_unit) < MIN_POINTS:
        raise CannotReconstruct(
            f"{len(points_in_unit)} distinct points are too few for a surface.", f"Give at least {MIN_POINTS}."
        )
    extents = np.linalg.svd(points_in_unit - points_in_unit.mean(axis=0), compute_uv=False)
    # This tolerates the rounding of large coordinates: 0.1 m at 1e7 m has steps of 2e-8 of its length.
    if extents[1] < 1e-6 * extents[0]:
        raise CannotReconstruct("All points lie on a line.", "A surface needs points that are spread over it.")
