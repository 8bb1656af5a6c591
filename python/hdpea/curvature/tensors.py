# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors of a cloud: an estimate in the unit frame, and the result in world units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.options.choice import Choice

Rows = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """The estimate at each point of a surface, in the unit frame.

    Attributes
    ----------
    normals
        (n, 3) float64, unit.
    direction1
        (n, 3) float64, unit tangents of k1, arbitrary where not `determined`.
    stretches, curvatures
        (n, 2) float64: s1 >= s2, and k1, k2 with |k1| >= |k2|, in 1 / unit length; NaN where unknown.
    determined
        (n,) bool: where the two principal directions can be told apart.
    """

    normals: Rows
    direction1: Rows
    stretches: Rows
    curvatures: Rows
    determined: NDArray[np.bool_]
    choices: tuple[Choice, ...] = ()


@dataclass(frozen=True)
class CurvatureTensors:
    """The curvature tensor at each point of a cloud, in world units.

    Principal curvature k1 is the one of larger magnitude, |k1| >= |k2|; direction 1 and stretch s1 >= s2 go with it.

    Attributes
    ----------
    points
        (n, 3) float64, in the order given: finite, distinct, and on a surface.
    normals
        (n, 3) float64, unit, consistently oriented.
    direction1, direction2
        (n, 3) float64, unit principal directions of k1 and k2, of either sign; 0 where not `determined`.
    stretches
        (n, 2) float64: how much the curvature metric stretches along them; NaN where unknown.
    curvatures
        (n, 2) float64: k1, k2 in 1 / length, convex positive where signed, else magnitudes; NaN where unknown.
    metric
        (n, 3, 3) float64: the metric tensor s1^2 d1 d1^T + s2^2 d2 d2^T + n n^T; NaN where unknown.
    determined
        (n,) bool: False where the surface is flat or round within the accuracy of the estimate, so that any two
        directions are principal ones, and where there are too few neighbours.
    point_index
        (n,) int64, ascending: the row of each among the points that were given, or in the file.
    signed
        Whether curvatures have signs.
    curvature_range
        The |k| that can be estimated: a value at an end of the range means that or beyond.
    choices
        What was chosen automatically.
    notes
        Remarks for the user, one sentence each.
    """

    points: Rows
    normals: Rows
    direction1: Rows
    direction2: Rows
    stretches: Rows
    curvatures: Rows
    metric: Rows
    determined: NDArray[np.bool_]
    point_index: NDArray[np.int64]
    signed: bool
    curvature_range: tuple[float, float]
    choices: tuple[Choice, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def stretching_ratio(self) -> Rows:
        """(n,) float64: s1 / s2, at least 1."""
        ratio: Rows = self.stretches[:, 0] / self.stretches[:, 1]
        return ratio
