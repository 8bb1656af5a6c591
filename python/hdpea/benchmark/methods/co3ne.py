# SPDX-License-Identifier: GPL-3.0-or-later
"""Concurrent co-cones on all points."""

from __future__ import annotations

import numpy as np

from hdpea.benchmark.methods import Cloud, geogram
from hdpea.benchmark.methods.options import Co3neOptions
from hdpea.geometry.triangles import TriangleMesh


def surface(cloud: Cloud, options: Co3neOptions) -> TriangleMesh:
    """Return the surface whose vertices are the points."""
    diagonal = float(np.linalg.norm(np.ptp(cloud.points, axis=0)))
    return geogram.co3ne(cloud, options.radius / 100 * diagonal)
