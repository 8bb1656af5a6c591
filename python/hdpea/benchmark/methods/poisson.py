# SPDX-License-Identifier: GPL-3.0-or-later
"""Screened Poisson surface reconstruction, then a reduction to the wanted size."""

from __future__ import annotations

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.meshlab import current_mesh, with_points
from hdpea.benchmark.methods.options import PoissonOptions
from hdpea.benchmark.methods.reduction import reduced
from hdpea.reading.triangle_mesh import TriangleMesh


def reconstruct(cloud: Cloud, vertices: int, options: PoissonOptions) -> TriangleMesh:
    """Reconstruct, then reduce."""
    document = with_points(cloud)
    document.generate_surface_reconstruction_screened_poisson(depth=options.depth, preclean=True)
    return reduced(current_mesh(document), vertices, options.reduce)
