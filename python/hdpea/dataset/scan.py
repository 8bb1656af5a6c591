# SPDX-License-Identifier: GPL-3.0-or-later
"""A simulated scan of a mesh: points, and what of the mesh each stands for."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Scan:
    """Points of a mesh as seen from outside, one row for each; all in the unit frame.

    Attributes
    ----------
    points
        (n, 3) float64, as the sensor measured them: `surface_points` moved along their rays; with faults, if any.
    surface_points
        (n, 3) float64: where the rays hit the mesh; for an outlier, the point of the scan nearest to it.
    normals
        (n, 3) float64, unit: normals of the faces hit, which face the sensor.
    faces
        (n,) int64: the faces hit.
    sensors
        (n, 3) float64: positions of the sensor, as far off as the view is misplaced.
    """

    points: NDArray[np.float64]
    surface_points: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.int64]
    sensors: NDArray[np.float64]

    def at(self, rows: NDArray[np.int64]) -> Scan:
        """Return the scan of these points only."""
        return Scan(**{each.name: getattr(self, each.name)[rows] for each in fields(self)})
