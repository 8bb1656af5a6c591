# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np
from helpers import clouds

from hdpea import _core
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.reaching import reach_points
from hdpea.surface.surface import Surface


def test_a_tip_that_was_cut_off_comes_back_with_its_embedding() -> None:
    points, normals = clouds.box(2000, (1.0, 0.2, 0.2))
    surface = Surface.of(UnitFrame.around(points), points, normals)
    coordinates = np.hstack([points, 0.1 * normals])
    lowest, highest = points.min(axis=0), points.max(axis=0) - [0.2, 0.0, 0.0]
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    vertices = np.where(corners == 1, highest, lowest)
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([face for a, b, c, d in sides for face in ((a, b, c), (a, c, d))])
    short = Mesh(vertices, faces, np.hstack([vertices, np.zeros((8, 3))]))

    reached = reach_points(short, surface, coordinates, 300)

    def farthest(mesh: Mesh) -> float:
        return float(_core.closest_surface_points(mesh.vertices_in_unit, mesh.faces, points).distance.max())

    assert farthest(reached) < 0.6 * farthest(short)  # of so few faces four rounds change few
    added = reached.vertices_in_unit[8:]
    assert len(added) > 0
    rows = _core.nearest_neighbors(points, added, 1)[:, 0]
    np.testing.assert_array_equal(added, points[rows])
    np.testing.assert_array_equal(reached.coordinates[8:], coordinates[rows])
