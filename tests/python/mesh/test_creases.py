# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds
from numpy.typing import NDArray

from hdpea import _core
from hdpea.reconstruction import reconstruct

COUNT = 4_000
SPACING = (6 / COUNT) ** 0.5
"""Of a unit cube."""


def _off_edges(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far places (m, 3) are from the edges of the unit cube around the origin."""
    off_sides = np.sort(abs(abs(places) - 0.5), axis=1)
    return np.linalg.norm(off_sides[:, :2], axis=1)


def test_creases_of_a_cube_lie_on_its_twelve_edges_and_meet_in_its_eight_corners():
    creases = _core.find_creases(*clouds.box(COUNT))
    assert _off_edges(creases.positions).max() < 0.3 * SPACING
    corners = {tuple(corner) for corner in np.sign(creases.corners).astype(int)}
    assert len(creases.corners) == len(corners) == 8
    assert abs(abs(creases.corners) - 0.5).max() < 0.3 * SPACING
    # Every piece of an edge, half a spacing long, has a sample near.
    stops = np.arange(-0.5, 0.5, SPACING / 2)
    edge = np.stack([stops, np.full_like(stops, 0.5), np.full_like(stops, 0.5)], axis=1)
    edges = np.vstack([np.roll(edge, axis, axis=1) for axis in range(3)])
    nearest = creases.positions[_core.nearest_neighbors(creases.positions, edges, 1)[:, 0]]
    assert np.linalg.norm(nearest - edges, axis=1).max() < SPACING


def test_a_slab_a_few_spacings_thick_has_its_eight_corners():
    half = np.array([0.5, 0.5, 0.05])
    creases = _core.find_creases(*clouds.box(3_000, (1, 1, 0.1)))
    assert {tuple(corner) for corner in np.sign(creases.corners).astype(int)} == {
        (x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)
    }
    assert abs(abs(creases.corners) - half).max() < 0.1 * half[2]


@pytest.mark.parametrize("count", [500, 2_000])
@pytest.mark.parametrize("seed", range(3))
def test_creases_go_all_around_the_rims_of_a_can(seed: int, count: int):
    # Their radius is 5 or 10 spacings: the tangents of such arcs meet outside.
    spacing = np.sqrt(1.5 * np.pi / count)
    creases = _core.find_creases(*clouds.can(count, seed))
    turns = np.linspace(0, 2 * np.pi, 200)
    rim = 0.5 * np.stack([np.cos(turns), np.sin(turns), np.ones_like(turns)], axis=1)
    rims = np.vstack([rim, rim * [1, 1, -1]])
    nearest = creases.positions[_core.nearest_neighbors(creases.positions, rims, 1)[:, 0]]
    assert np.linalg.norm(nearest - rims, axis=1).max() < 0.75 * spacing
    for places in (creases.positions, creases.corners):
        across = np.linalg.norm(places[:, :2], axis=1) - 0.5
        assert np.hypot(across, abs(places[:, 2]) - 0.5).max() < 0.3 * spacing


def test_creases_do_not_need_the_normals_of_either_side():
    points, normals = clouds.box(COUNT)
    neighbors = _core.nearest_neighbors(points, 12)
    smeared = normals + normals[neighbors].sum(axis=1)
    smeared /= np.linalg.norm(smeared, axis=1, keepdims=True)
    creases = _core.find_creases(points, smeared)
    assert len(creases.corners) == 8
    assert _off_edges(creases.positions).max() < 0.3 * SPACING


@pytest.mark.parametrize("noise", [0.0, 0.2, 0.5])
def test_round_things_have_no_creases_whatever_their_noise(noise: float):
    points, normals = clouds.ellipsoid(COUNT)
    spacing = np.sqrt(5 / COUNT)
    noisy = points + noise * spacing * np.random.default_rng(0).normal(size=points.shape)
    assert len(_core.find_creases(noisy, normals).positions) == 0


@pytest.mark.parametrize("noise", [0.05, 0.1])
def test_noise_leaves_the_edges_of_a_cube(noise: float):
    points, normals = clouds.box(COUNT)
    noisy = points + noise * SPACING * np.random.default_rng(0).normal(size=points.shape)
    creases = _core.find_creases(noisy, normals)
    assert len(creases.positions) > 12 / SPACING
    assert _off_edges(creases.positions).max() < 0.5 * SPACING


def test_a_mesh_has_edges_along_the_edges_of_a_cube():
    made = reconstruct(*clouds.box(COUNT), vertices=500)
    creases = _core.find_creases(*clouds.box(COUNT))
    edges = _core.crease_edges(made.vertices, made.faces, creases)
    assert made.report.meshing["crease_edges"] == len(edges) > 0
    ends = made.vertices[edges]
    assert _off_edges(ends.reshape(-1, 3)).max() < 0.25 * SPACING
    # Between them they are as long as the twelve edges.
    assert abs(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() - 12) < 0.3
    assert made.report.mesh.closed
    assert made.report.mesh.self_intersections == 0


def test_a_mesh_without_creases_stays_as_it_is():
    points, normals = clouds.sphere(COUNT)
    mesh = reconstruct(points, normals, vertices=300)
    assert mesh.report.meshing["crease_edges"] == 0
    same = _core.align_to_creases(mesh.vertices, mesh.faces, _core.find_creases(points, normals))
    np.testing.assert_array_equal(same.vertices, mesh.vertices)
    np.testing.assert_array_equal(same.faces, mesh.faces)
