# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np

from hdpea import _core
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.repair import repair_mesh


def _grid(count: int) -> Mesh:
    x, y = np.meshgrid(np.arange(count) / count, np.arange(count) / count, indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(count * count)], axis=1)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    lower = np.stack([corner, corner + count, corner + 1], axis=1)
    upper = np.stack([corner + 1, corner + count, corner + count + 1], axis=1)
    return Mesh(vertices, np.concatenate([lower, upper]), np.hstack([vertices, np.zeros((len(vertices), 5))]))


def test_a_vertex_that_was_moved_through_other_faces_comes_back():
    flat = _grid(11)
    flat.vertices_in_unit[60] += [0.25, 0.03, 0.0]
    assert _core.count_self_intersections(flat.vertices_in_unit, flat.faces) > 0
    mended = repair_mesh(flat)
    assert _core.count_self_intersections(mended.vertices_in_unit, mended.faces) == 0
    assert len(mended.coordinates) == len(mended.vertices_in_unit)


def test_a_mesh_without_self_intersections_stays_as_it_is():
    flat = _grid(6)
    same = repair_mesh(flat)
    np.testing.assert_array_equal(same.vertices_in_unit, flat.vertices_in_unit)
    np.testing.assert_array_equal(same.faces, flat.faces)
    np.testing.assert_array_equal(same.coordinates, flat.coordinates)
