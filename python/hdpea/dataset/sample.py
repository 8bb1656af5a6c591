# SPDX-License-Identifier: GPL-3.0-or-later
"""A sample: points of a known surface, and the truth at each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.unit_frame import UnitFrame


@dataclass(frozen=True)
class Sample:
    """Points of a known surface in its unit frame, in which the bounding-box diagonal of the *mesh* is 1.

    Attributes
    ----------
    points
        (n, 3) float32, as a sensor would measure them: with noise, if any.
    surface_points
        (n, 3) float32, the true points of the surface that `points` represent; equal to them without noise.
    normals
        (n, 3) float32, unit, those of the mesh's faces at `surface_points`, outward.
    psi
        (n, 5) float32, the extra coordinates of the true embedding: `embedding` is [surface_points, psi].
    curvatures
        (n, 2) float32, principal curvatures k1, k2 with |k1| >= |k2|, in 1 / unit length; convex is positive.
    direction1
        (n, 3) float32, unit principal direction of k1; that of k2 is normal x direction1.
    frame
        The unit frame, in world units.
    estimated_normals
        (n, 3) float32, unit, estimated and oriented from `points` alone; None if not requested.
    sensors
        (n, 3) float32, position of the sensor that saw each point; None if the points are not of a scan.
    """

    points: NDArray[np.float32]
    surface_points: NDArray[np.float32]
    normals: NDArray[np.float32]
    psi: NDArray[np.float32]
    curvatures: NDArray[np.float32]
    direction1: NDArray[np.float32]
    frame: UnitFrame
    estimated_normals: NDArray[np.float32] | None = None
    sensors: NDArray[np.float32] | None = None

    @property
    def embedding(self) -> NDArray[np.float32]:
        """(n, 8) float32: the points of the surface, then psi; distances are lengths under the metric."""
        return np.hstack([self.surface_points, self.psi])
