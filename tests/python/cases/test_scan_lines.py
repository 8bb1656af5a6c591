# SPDX-License-Identifier: GPL-3.0-or-later
"""Dense along lines, sparse across: a whole surface, and no fans across what was not seen."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import TAU
from helpers.raw_clouds import ROOM, contours, crossed_profiles, lidar_ground, lidar_room, rings, tube_profiles
from helpers.raw_meshes import area, assert_ball, middles, share_against, share_of_area
from helpers.reconstructions import area_vectors

from hdpea import _core, reconstruct


@pytest.mark.parametrize("with_normals", [False, True])
@pytest.mark.parametrize("ratio", [5.0, 20.0])
def test_rings_of_a_ball_give_the_ball(ratio: float, with_normals: bool) -> None:
    points = rings(30, ratio)
    assert_ball(reconstruct(points, points if with_normals else None), within=0.05)


@pytest.mark.parametrize("of_each", [300, 600])
def test_contours_give_one_surface(of_each: int) -> None:
    made = reconstruct(contours(25, of_each))
    mesh = made.report.mesh
    assert (mesh.components, mesh.self_intersections) == (1, 0)
    assert mesh.boundary_loops <= 2
    # From the lowest contour to the highest, with or without the two caps.
    height, around = np.meshgrid(np.linspace(-0.97, 0.97, 200), np.linspace(0, TAU, 200), indexing="ij")
    radius = np.sqrt(1 - height**2)
    corners = np.stack([radius * np.cos(around), 0.7 * radius * np.sin(around), 1.2 * height], axis=-1)
    across, along = np.diff(corners, axis=0)[:, :-1], np.diff(corners, axis=1)[:-1]
    band = np.linalg.norm(np.cross(across, along), axis=-1).sum()
    assert 0.95 * band < area(made) < 1.05 * band + 2 * np.pi * 0.7 * 0.25**2


def test_profiles_of_a_tube_give_the_tube() -> None:
    made = reconstruct(tube_profiles(40, 320))
    mesh = made.report.mesh
    assert (mesh.components, mesh.self_intersections) == (1, 0)
    assert area(made) == pytest.approx(39 * TAU, rel=0.1)


@pytest.mark.slow
def test_a_room_seen_by_sixteen_beams_has_no_sheets_in_its_air() -> None:
    points = lidar_room(16, 0.2)
    made = reconstruct(points)
    inside = np.minimum(middles(made) - ROOM[0], ROOM[1] - middles(made)).min(axis=1)
    assert share_of_area(made, inside > 0.5) < 0.02
    missed = _core.closest_surface_points(made.vertices, made.faces, points).distance > 0.2
    assert missed.mean() < 0.05 or made.report.missed


@pytest.mark.parametrize("ratio", [12, 20])
def test_profiles_both_ways_give_one_sheet(ratio: int) -> None:
    made = reconstruct(crossed_profiles(20, ratio))
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 1, 0)
    assert area(made) == pytest.approx(19**2, rel=0.08)
    assert share_against(made, np.array([0, 0, 1.0])) < 0.01
    assert not made.report.missed


def test_ground_whose_far_rings_are_a_small_share_of_the_points_is_whole() -> None:
    made = reconstruct(lidar_ground(128, 0.6))
    assert made.report.mesh.components == 1
    assert area(made) == pytest.approx(np.pi * (39**2 - 3.7**2), rel=0.02)


@pytest.mark.parametrize("beams", [32, pytest.param(64, marks=pytest.mark.slow)])
def test_no_fan_is_put_into_a_hole_that_is_to_stay_open(beams: int) -> None:
    made = reconstruct(lidar_ground(beams, 25.6 / beams), fill_holes=2.0)
    assert made.report.mesh.self_intersections == 0
    up = np.array([0, 0, 1.0]) * np.sign(area_vectors(made)[:, 2].sum())
    assert share_against(made, up) < 1e-9
    # Nothing was seen nearer than 3.6 m, all around.
    assert np.linalg.norm(middles(made)[:, :2], axis=1).min() > 3
