# SPDX-License-Identifier: GPL-3.0-or-later
"""From the network's psi to one that satisfies the metric: some rounds of the core's solver.

A network predicts how psi varies over a whole part, with an error of some percent. Local/global iteration is the
opposite: it is accurate locally, but takes many rounds until distant parts agree, unless it starts close to a solution.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.metric import ScaledMetric
from hdpea.surface.triangle_soup import triangle_soup

ROUNDS = 8
"""Default number of local/global iterations; ``benchmarks/settling_table.py`` compares others."""

Array = NDArray[np.float64]


def settled(
    points: Array,
    normals: Array,
    neighbors: NDArray[np.int64],
    psi: Array,
    metric: ScaledMetric,
    rounds: int = ROUNDS,
) -> Array:
    """Return psi (n, 5), smoother and closer to isometric under the metric.

    Parameters
    ----------
    points
        (n, 3), in spacings.
    normals
        (n, 3), unit, consistently oriented.
    neighbors
        (n, k): nearest points of the same sheet, nearest first, -1 pads.
    psi
        (n, 5), in spacings.
    metric
        The one that the network was trained on, in spacings.
    rounds
        Iterations of the solver; 0 returns psi as it is.
    """
    if not rounds:
        return psi
    solver = metric.solver()
    solver.iterations = rounds
    soup = triangle_soup(points, normals, neighbors)
    curvature = _core.estimate_curvature(points, normals, neighbors, metric.curvature_radius)
    return _core.solve_embedding(points, normals, curvature, soup.triangles, soup.weights, solver, initial=psi)
