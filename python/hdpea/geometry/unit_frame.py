# SPDX-License-Identifier: GPL-3.0-or-later
"""The unit frame: where all computing happens, far from large coordinates and free of units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import CannotReconstruct
from hdpea.options.lengths import Length


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
            If all points are equal.
        """
        lowest, highest = points_in_world.min(axis=0), points_in_world.max(axis=0)
        diagonal = float(np.linalg.norm(highest - lowest))
        if diagonal == 0:
            raise CannotReconstruct("All points are equal.", "A surface needs points that are spread over it.")
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
