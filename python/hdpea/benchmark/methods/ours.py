# SPDX-License-Identifier: GPL-3.0-or-later
"""hdpea itself."""

from __future__ import annotations

from dataclasses import replace

from hdpea import reconstruct as reconstruct_points
from hdpea.benchmark.methods import Cloud
from hdpea.geometry.triangles import TriangleMesh
from hdpea.options import Options


def reconstruct(cloud: Cloud, vertices: int, options: Options) -> TriangleMesh:
    """Reconstruct with the budget of the suite and otherwise the given options."""
    budgeted = replace(options, meshing=replace(options.meshing, vertices=vertices))
    made = reconstruct_points(cloud.points, cloud.normals, budgeted)
    return made.vertices, made.faces
