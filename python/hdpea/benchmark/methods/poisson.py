# SPDX-License-Identifier: GPL-3.0-or-later
"""Screened Poisson surface reconstruction."""

from __future__ import annotations

import numpy as np

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.methods.meshlab import current_mesh, with_points
from hdpea.benchmark.methods.options import PoissonOptions
from hdpea.geometry.triangles import TriangleMesh
from hdpea.reading.triangle_mesh import drop_unused


def surface(cloud: Cloud, options: PoissonOptions) -> TriangleMesh:
    """Return the surface at the resolution of the octree; trimmed where points are sparse, if the options say so."""
    document = with_points(cloud)
    document.generate_surface_reconstruction_screened_poisson(depth=options.depth, preclean=True)
    vertices, faces = current_mesh(document)
    if options.trim == 0:
        return vertices, faces
    levels = document.current_mesh().vertex_scalar_array()
    kept = levels >= np.median(levels) - options.trim
    return drop_unused(vertices, faces[kept[faces].all(axis=1)])
