# SPDX-License-Identifier: GPL-3.0-or-later
"""Mending faces that cut others, which the fit to noisy points leaves here and there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.extraction import Mesh

FARTHEST = 0.4
"""How far from the mesh a point may get by mending, in spacings of the vertices.

With 0.5, flex_hose and goblet_top have 20 and 13 pairs of faces fewer that cut each other, but their farthest points are
1.3 and 1.2 times as far."""


def repair_mesh(mesh: Mesh, points: NDArray[np.float64]) -> Mesh:
    """Return the mesh without its self-intersections, but for those that could be mended only by losing points.

    These are where the walls of thin parts pass through each other.

    Parameters
    ----------
    points
        (n, 3) float64, in the unit frame: what the mesh is to stay near.
    """
    spacing = np.sqrt(mesh_area(mesh.vertices_in_unit, mesh.faces) / len(mesh.vertices_in_unit))
    with core_errors_translated():
        repaired = _core.repair_self_intersections(mesh.vertices_in_unit, mesh.faces, points, FARTHEST * spacing)
        same = _core.nearest_neighbors(mesh.vertices_in_unit, repaired.vertices, 1)[:, 0]
    return replace(
        mesh,
        vertices_in_unit=repaired.vertices,
        faces=repaired.faces,
        coordinates=mesh.coordinates[same],
        self_intersections=repaired.self_intersections,
    )
