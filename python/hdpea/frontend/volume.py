# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds that show no surface because they fill a volume: voxels of a solid, what a simulation fills."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.roughness import Roughness
from hdpea.geometry.thinning import rows_along

SAMPLES = 300
"""Points at which the dimension is measured."""

PART, MOST = 16, 2_000
"""The share of a cloud, one in so many, and the most points that its dimension is measured in."""

LEAST_ROUGHNESS = 1.1
"""Roughness, in spacings, of which a volume has more: a regular grid of 1,000 points has 1.2, most others 1.4 to 5."""

LEAST_DIMENSION = 2.6
"""Dimension of which a volume has more: what surrounds a point grows with this power of the distance.

Balls, cubes and their regular grids of 500 to 60,000 points have 2.63 to 3.3, less than 3 for their borders; of 42
training meshes (2,000 to 40,000 points, noise of 0 to 1 % of the diagonal) that are as rough, one has more than 2.55: a
lattice that fills a cube, with noise as wide as its struts."""


def fills_a_volume(points: NDArray[np.float64], roughness: Roughness) -> bool:
    """Tell whether points (n, 3), distinct and of that roughness, fill a volume rather than lie near a surface."""
    far = min(len(points) // PART, MOST)
    near = far // 4
    if roughness.deviation < LEAST_ROUGHNESS or near < 1:
        return False
    queries = np.ascontiguousarray(points[rows_along(len(points), SAMPLES)])
    # The nearest to a point of the cloud is the point itself.
    nearest = _core.nearest_neighbors(points, queries, far + 1)[:, [near, far]]
    radii = np.linalg.norm(points[nearest] - queries[:, None], axis=2)
    growth = np.log(radii[:, 1] / radii[:, 0])
    # The dimension is the slope of the logarithm of the number of points, without the bias of few (Levina and Bickel).
    numbers = (1 / np.arange(near, far)).sum()
    return bool(np.median(growth) * LEAST_DIMENSION < numbers)
