# SPDX-License-Identifier: GPL-3.0-or-later
"""Ball pivoting on all points."""

from __future__ import annotations

import numpy as np
import pymeshlab

from hdpea import _core
from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.meshlab import current_mesh, with_points
from hdpea.benchmark.methods.options import BallPivotingOptions
from hdpea.geometry.triangles import TriangleMesh


def surface(cloud: Cloud, options: BallPivotingOptions) -> TriangleMesh:
    """Return the surface whose vertices are the points."""
    document = with_points(cloud)
    for radius in _radii(cloud, options.radius):
        document.generate_surface_reconstruction_ball_pivoting(ballradius=pymeshlab.PercentageValue(radius))
    return current_mesh(document)


def _radii(cloud: Cloud, radius: float) -> tuple[float, ...]:
    """Return the radii, in percent of the diagonal, of the balls that pivot one after another.

    MeshLab's own guess leaves a third of the surface open on randomly sampled points.
    """
    if radius:
        return (radius,)
    sixth = _core.nearest_neighbors(cloud.points, 6)[:, 5]
    guessed = np.linalg.norm(cloud.points[sixth] - cloud.points, axis=1).mean()
    share = 100 * float(guessed / np.linalg.norm(np.ptp(cloud.points, axis=0)))
    return (share, 2 * share)
