# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a mesh reaches beyond the outermost points of an open cloud, as docs/limits.md says."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea import reconstruct
from hdpea.geometry.triangles import mesh_area
from hdpea.options.meshing import POINTS_PER_VERTEX

FARTHEST = 0.7
"""In spacings of one vertex for every 8 points; at most 0.6 measured."""


@pytest.mark.parametrize("vertices", [None, 60])
def test_borders_reach_little_beyond_the_points(vertices: int | None) -> None:
    points, normals = clouds.plane(2000)
    mesh = reconstruct(points, normals, vertices=vertices)
    beyond = np.maximum(mesh.vertices - points.max(axis=0), points.min(axis=0) - mesh.vertices)[:, :2].max()
    spacing = np.sqrt(mesh_area(mesh.vertices, mesh.faces) * POINTS_PER_VERTEX / len(points))
    assert 0 < beyond < FARTHEST * spacing
