# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hdpea import _core
from hdpea.mesh import repair
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.repair import FARTHEST, repair_mesh


def _grid(count: int) -> Mesh:
    x, y = np.meshgrid(np.arange(count) / count, np.arange(count) / count, indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(count * count)], axis=1)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    lower = np.stack([corner, corner + count, corner + 1], axis=1)
    upper = np.stack([corner + 1, corner + count, corner + count + 1], axis=1)
    return Mesh(vertices, np.concatenate([lower, upper]), np.hstack([vertices, np.zeros((len(vertices), 5))]))


MIDDLE = np.array([[0.5, 0.5, 0.0]])


def test_a_vertex_that_was_moved_through_other_faces_comes_back():
    flat = _grid(11)
    flat.vertices_in_unit[60] += [0.25, 0.03, 0.0]
    assert _core.count_self_intersections(flat.vertices_in_unit, flat.faces) > 0
    mended = repair_mesh(flat, MIDDLE)
    assert _core.count_self_intersections(mended.vertices_in_unit, mended.faces) == 0
    assert len(mended.coordinates) == len(mended.vertices_in_unit)


def test_a_mesh_without_self_intersections_stays_as_it_is():
    flat = _grid(6)
    same = repair_mesh(flat, MIDDLE)
    np.testing.assert_array_equal(same.vertices_in_unit, flat.vertices_in_unit)
    np.testing.assert_array_equal(same.faces, flat.faces)
    np.testing.assert_array_equal(same.coordinates, flat.coordinates)


def test_what_would_lose_points_is_not_mended():
    spiked = _grid(11)
    # Two spikes that lean through each other: mended, both are gone.
    tips = np.array([[0.65, 0.45, 0.6], [0.25, 0.47, 0.6]])
    spiked.vertices_in_unit[[48, 70]] = tips
    assert _core.count_self_intersections(spiked.vertices_in_unit, spiked.faces) > 0
    spacing = np.sqrt(1 / len(spiked.vertices_in_unit))
    for points, tips_stay in ((tips, True), (MIDDLE, False)):
        mended = repair_mesh(spiked, points)
        away = _core.closest_surface_points(mended.vertices_in_unit, mended.faces, tips).distance
        assert (away.max() <= FARTHEST * spacing) == tips_stay


def test_what_mending_cuts_off_goes_and_small_pieces_stay(monkeypatch: pytest.MonkeyPatch) -> None:
    flat, small = _grid(11), _grid(3)
    both = Mesh(
        np.vstack([flat.vertices_in_unit, small.vertices_in_unit + 5]),
        np.vstack([flat.faces, small.faces + len(flat.vertices_in_unit)]),
        np.vstack([flat.coordinates, small.coordinates + 5]),
    )
    # Without the faces around it a corner of the large grid is an island.
    x, y = both.vertices_in_unit[both.faces].mean(axis=1)[:, :2].T
    cut = replace(both, faces=both.faces[(np.maximum(x, y) > 0.3) | (np.maximum(x, y) < 0.2)], self_intersections=0)
    monkeypatch.setattr(repair, "_repaired", lambda *_: cut)
    mended = repair_mesh(both, MIDDLE, exact=False)
    corners = mended.vertices_in_unit[mended.faces].reshape(-1, 3)
    assert ((corners[:, 0] > 4) | (corners[:, :2].max(axis=1) >= 0.2)).all()
    assert (corners[:, 0] > 4).sum() == 3 * len(small.faces)
    assert len(mended.coordinates) == len(mended.vertices_in_unit)
    np.testing.assert_array_equal(mended.coordinates[:, :3], mended.vertices_in_unit)
