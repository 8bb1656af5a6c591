# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds that were not seen from the origin, told by how they spread: even neither as seen nor along the surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.frontend.vantage import NEAREST, unevenness

Vectors = NDArray[np.float64]

MOST_UNEVEN = 1.0
"""Unevenness, as of ``hdpea.frontend.vantage``, that points have neither along the surface nor as seen from the origin.

What a camera there saw is even as seen, what was fused of its pictures along the surface: of 202 simulated views, of 52
meshes and of walls, the lesser of both is 0.53 at most; of ground around a scanner elsewhere 1.7."""

GRID, LEAST_OF_PICTURE, RATIO = 0.05, 0.015, 3.0
"""Most unevenness of the nearest points in plan where they are a grid; and least in the picture, also in times of that
of the plan, where they are none there. All but 2 % at either end count.

Grids of land, also turned and rounded to a hundredth of their step, have 0.012 at most in plan. In what a camera saw
the pixels are the grid, of what was fused there is none; and a wall that faces the camera is one in both."""


def hardly_seen_from(points: Vectors, origin: Vectors) -> bool:
    """Tell whether points (n, 3) are spread as what was seen from the origin (3,) is not.

    That is even as seen or, fused of many pictures, along the surface: ground around a scanner elsewhere is neither.
    And land on a grid in plan is on none in a picture.
    """
    sight = points - origin
    ranges = np.linalg.norm(sight, axis=1, keepdims=True)
    if len(points) <= NEAREST or not ranges.all():
        return False
    rays = sight / ranges
    if min(unevenness(places) for places in (points, rays)) > MOST_UNEVEN:
        return True
    picture = rays / (rays @ rays.mean(axis=0))[:, None]
    plan = points * [1.0, 1.0, 0.0]
    of_plan, of_picture = (unevenness(places, 1, 0.02) for places in (plan, picture))
    return of_plan < GRID and of_picture > max(LEAST_OF_PICTURE, RATIO * of_plan)
