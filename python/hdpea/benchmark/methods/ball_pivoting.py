# SPDX-License-Identifier: GPL-3.0-or-later
"""Ball pivoting over all points, then a reduction to the wanted size."""

from __future__ import annotations

import pymeshlab

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.meshlab import current_mesh, with_points
from hdpea.benchmark.methods.options import BallPivotingOptions
from hdpea.benchmark.methods.reduction import reduced
from hdpea.reading.triangle_mesh import TriangleMesh


def reconstruct(cloud: Cloud, vertices: int, options: BallPivotingOptions) -> TriangleMesh:
    """Reconstruct, then reduce."""
    document = with_points(cloud)
    document.generate_surface_reconstruction_ball_pivoting(ballradius=pymeshlab.PercentageValue(options.radius))
    return reduced(current_mesh(document), vertices, options.reduce)
