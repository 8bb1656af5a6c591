# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np

from hdpea import _core
from hdpea.tiling.regions import points_at, region_of

SIDE = 12


def grid() -> np.ndarray:
    """Return the faces of a square of 12 x 12 vertices."""
    corner = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    a, b, c, d = (each.ravel() for each in (corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]))
    return np.vstack([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def test_a_region_is_manifold_and_what_it_shares_with_the_rest_is_fixed() -> None:
    faces, random = grid(), np.random.default_rng(0)
    unknown = np.zeros(SIDE * SIDE, dtype=bool)
    for share in (0.1, 0.3, 0.6):
        wanted = random.random(len(faces)) < share
        region = region_of(faces, wanted, unknown)
        assert set(np.flatnonzero(wanted)) <= set(region.rows)
        np.testing.assert_array_equal(region.vertices[region.faces], faces[region.rows])
        outside = np.delete(faces, region.rows, axis=0)
        assert set(region.vertices[region.mask]) == set(region.vertices) & set(outside.ravel())
        positions = random.random((len(region.vertices), 3))
        assert _core.check_mesh(positions, region.faces).manifold


def test_vertices_of_which_not_all_faces_are_known_are_fixed() -> None:
    faces = grid()
    unknown = np.arange(SIDE * SIDE) < SIDE
    region = region_of(faces, np.ones(len(faces), dtype=bool), unknown)
    assert set(region.vertices[region.mask]) == set(range(SIDE))


def test_points_of_a_region_are_not_those_of_what_passes_by() -> None:
    faces, side = grid(), np.linspace(0, 1, SIDE)
    x, y = (each.ravel() for each in np.meshgrid(side, side, indexing="ij"))
    sheet = np.stack([x, y, 0 * x], axis=1)
    # Two sheets, of which the second is not known to the region, but near to it.
    vertices = np.vstack([sheet, sheet + np.array([0, 0, 0.3])])
    known = np.vstack([faces, faces + len(sheet)])
    wanted = np.arange(len(known)) < len(faces)
    wanted[: len(faces)] &= vertices[faces].mean(axis=1)[:, 0] < 0.45
    region = region_of(known, wanted, np.zeros(len(vertices), dtype=bool))
    points = np.array([[0.2, 0.5, 0.05], [0.2, 0.5, 0.25], [0.5, 0.5, 0], [0.9, 0.5, 0]])
    # The third lies beyond the rim, on a face at it.
    np.testing.assert_array_equal(points_at(region, vertices, known, points), [True, False, True, False])
