# SPDX-License-Identifier: GPL-3.0-or-later
"""Concurrent co-cones over all points, then a reduction to the wanted size."""

from __future__ import annotations

import numpy as np

from hdpea.benchmark.methods import Cloud, geogram
from hdpea.benchmark.methods.options import Co3neOptions
from hdpea.benchmark.methods.reduction import reduced
from hdpea.reading.triangle_mesh import TriangleMesh


def reconstruct(cloud: Cloud, vertices: int, options: Co3neOptions) -> TriangleMesh:
    """Reconstruct, then reduce."""
    diagonal = float(np.linalg.norm(np.ptp(cloud.points, axis=0)))
    return reduced(geogram.co3ne(cloud, options.radius / 100 * diagonal), vertices, options.reduce)
