# SPDX-License-Identifier: GPL-3.0-or-later
"""Screened Poisson surface reconstruction."""

from __future__ import annotations

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.meshlab import current_mesh, with_points
from hdpea.benchmark.methods.options import PoissonOptions
from hdpea.reading.triangle_mesh import TriangleMesh


def surface(cloud: Cloud, options: PoissonOptions) -> TriangleMesh:
    """Return the surface, of as many vertices as the octree gives it."""
    document = with_points(cloud)
    document.generate_surface_reconstruction_screened_poisson(depth=options.depth, preclean=True)
    return current_mesh(document)
