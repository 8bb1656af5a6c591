# SPDX-License-Identifier: GPL-3.0-or-later
"""The unit frame: where all computing happens, far from large coordinates and free of units."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import CannotReconstruct
from hdpea.options.lengths import Length


def diagonal_of(lowest: NDArray[np.float64], highest: NDArray[np.float64]) -> float:
    """Return the length of the diagonal of a box, whatever its magnitude; infinity if no double holds it."""
    with np.errstate(over="ignore"):
        extents = highest - lowest
    largest = float(extents.max())
    if not math.isfinite(largest) or largest == 0:
        return largest
    # A power of two, by which scaling is exact: squares of lengths beyond 1e154 overflow, below 1e-154 they vanish.
    _, exponent = math.frexp(largest)
    try:
        return math.ldexp(float(np.linalg.norm(np.ldexp(extents, -exponent))), exponent)
    except OverflowError:
        return math.inf


@dataclass(frozen=True)
class UnitFrame:
    """A frame centred on the cloud, in which its bounding-box diagonal is 1.

    Attributes
    ----------
    centre_in_world
        (3,) float64, the middle of the bounding box.
    diagonal
        Length of the bounding box's diagonal in world units; lengths in the unit frame are shares of it.
    """

    centre_in_world: NDArray[np.float64]
    diagonal: float

    @classmethod
    def around(cls, points_in_world: NDArray[np.float64]) -> UnitFrame:
        """Return the frame of points (n, 3).

        Raises
        ------
        CannotReconstruct
            If all points are equal, or the diagonal is no double.
        """
        lowest, highest = points_in_world.min(axis=0), points_in_world.max(axis=0)
        diagonal = diagonal_of(lowest, highest)
        if diagonal == 0:
            raise CannotReconstruct("All points are equal.", "A surface needs points that are spread over it.")
        if not math.isfinite(diagonal):
            raise CannotReconstruct("The coordinates are too large for double precision.", "Scale the points down.")
        return cls(lowest + (highest - lowest) / 2, diagonal)

    def to_unit(self, points_in_world: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points (n, 3) of the world in the unit frame."""
        return (points_in_world - self.centre_in_world) / self.diagonal

    def to_world(self, points_in_unit: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points (n, 3) of the unit frame in the world."""
        return points_in_unit * self.diagonal + self.centre_in_world

    def length_to_unit(self, length: Length) -> float:
        """Return a length as users give it (world units or percent of the diagonal) in the unit frame."""
        return length.resolve(self.diagonal) / self.diagonal
