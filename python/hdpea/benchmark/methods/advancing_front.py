# SPDX-License-Identifier: GPL-3.0-or-later
"""Advancing front surface reconstruction of all points, by CGAL."""

from __future__ import annotations

import numpy as np
from CGAL.CGAL_Advancing_front_surface_reconstruction import advancing_front_surface_reconstruction
from CGAL.CGAL_Kernel import Point_3
from CGAL.CGAL_Point_set_3 import Point_set_3

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.options import AdvancingFrontOptions
from hdpea.geometry.triangles import TriangleMesh


def surface(cloud: Cloud, options: AdvancingFrontOptions) -> TriangleMesh:
    """Return the surface whose vertices are the points."""
    del options  # which concern only the reduction
    points, corners = Point_set_3(), list[int]()
    for point in cloud.points.tolist():
        points.insert(Point_3(*point))
    advancing_front_surface_reconstruction(points, corners)
    return cloud.points, np.array(corners, np.int64).reshape(-1, 3)
