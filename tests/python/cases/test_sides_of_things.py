# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side is out of things that touch, and of open scenes."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from helpers.raw_clouds import (
    ball_on_a_floor,
    box_on_a_table,
    land_with_a_cliff,
    land_with_trees,
    lidar_frame,
    noisy_ground,
    table_from_above,
    turned_wall,
)
from helpers.raw_meshes import BALL, area, middles, says_it_is_a_guess, share_against
from helpers.reconstructions import area_vectors, volume

from hdpea import _core, reconstruct
from hdpea.frontend.one_layer import are_of_one_layer

UP = np.array([0.0, 0.0, 1.0])


@pytest.mark.parametrize("apart", [0.0, 0.04])
def test_two_balls_that_touch_are_two_and_both_face_out(apart: float) -> None:
    made = reconstruct(np.vstack([sphere_points(2500, 1), sphere_points(2500, 2) + np.array([2 + apart, 0, 0])]))
    mesh = made.report.mesh
    assert (mesh.closed, mesh.components, mesh.genus, mesh.self_intersections) == (True, 2, 0, 0)
    assert volume(made) == pytest.approx(2 * BALL, rel=0.03)


def test_a_ball_on_a_floor_faces_out() -> None:
    made = reconstruct(ball_on_a_floor(2500))
    places, normals = middles(made), area_vectors(made)
    on_ball = (abs(np.linalg.norm(places, axis=1) - 1) < 0.05) & (places[:, 2] > -0.8)
    outward = (normals * places).sum(axis=1)[on_ball]
    assert on_ball.sum() > 500
    assert (outward > 0).mean() > 0.995


@pytest.mark.parametrize("noise", [0.7, 1.0])
def test_ground_with_wide_noise_is_one_sheet_that_faces_up(noise: float) -> None:
    made = reconstruct(noisy_ground(8000, noise))
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 1, 0)
    assert share_against(made, UP) < 1e-9


def test_a_plate_whose_noise_hides_its_sides_is_not_one_layer() -> None:
    assert are_of_one_layer(noisy_ground(8000, 1.0))
    assert not are_of_one_layer(noisy_ground(8000, 0.7, thick=2))
    assert not are_of_one_layer(noisy_ground(1000, 1.0))


@pytest.mark.parametrize("on_a_grid", [False, True])
@pytest.mark.parametrize("count", [300, 1500])
@pytest.mark.parametrize("degrees", [60, 90])
def test_a_flat_wall_is_one_sheet_however_it_is_turned(count: int, on_a_grid: bool, degrees: float) -> None:
    points = turned_wall(count, on_a_grid, degrees)
    made = reconstruct(points)
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 1, 0)
    spacing = np.sqrt(12 / count)
    assert _core.closest_surface_points(made.vertices, made.faces, points).distance.max() < spacing
    # The border of the mesh lies beyond the last points.
    assert 12 < area(made) < (4 + 3 * spacing) * (3 + 3 * spacing)
    assert not made.report.missed


def test_all_pieces_of_a_height_field_face_the_same_way() -> None:
    made = reconstruct(land_with_a_cliff(2))
    assert share_against(made, UP) < 0.01 or (share_against(made, -UP) < 0.01 and says_it_is_a_guess(made))


def test_a_box_on_a_table_faces_out_where_the_table_faces_up() -> None:
    made = reconstruct(box_on_a_table(10_000))
    places = middles(made)
    side = (abs(places[:, :2]).max(axis=1) < 0.6) & (places[:, 2] > 0.1) & (places[:, 2] < 0.9)
    outward = np.where(side[:, None], places * [1, 1, 0], UP)
    against = share_against(made, outward)
    assert against < 0.04 or (against > 0.96 and says_it_is_a_guess(made))


def test_a_fruit_in_a_bowl_faces_out() -> None:
    bowl = sphere_points(6000, 1)
    middle = np.array([0.1, 0.0, -0.45])
    made = reconstruct(np.vstack([bowl[bowl[:, 2] < 0.1], middle + 0.35 * sphere_points(1500, 2)]))
    places = middles(made) - middle
    of_fruit = np.linalg.norm(places, axis=1) < 0.4
    assert of_fruit.sum() > 100
    assert ((area_vectors(made) * places).sum(axis=1)[of_fruit] > 0).all()


@pytest.mark.parametrize("rings", [32, 64])
def test_what_a_lidar_sees_around_it_faces_it(rings: int) -> None:
    made = reconstruct(lidar_frame(rings))
    assert share_against(made, -middles(made)) < 0.03
    assert not says_it_is_a_guess(made)


def test_the_underside_of_what_hovers_over_a_floor_faces_down() -> None:
    floor = np.column_stack([np.random.default_rng(0).uniform(-3, 3, (12_000, 2)), np.zeros(12_000)])
    middle = np.array([0, 0, 0.7])
    made = reconstruct(np.vstack([floor, middle + 0.4 * sphere_points(700, 1)]))
    of_ball = middles(made)[:, 2] > 0.2
    assert of_ball.sum() > 100
    assert share_against(made, np.where(of_ball[:, None], middles(made) - middle, UP)) < 0.001


def test_land_faces_up_though_a_laser_went_through_its_trees() -> None:
    made = reconstruct(land_with_trees(8_000))
    assert share_against(made, UP) < 0.1  # the trees from below; 0.8 where what is closed decides
    assert not says_it_is_a_guess(made)
    # Crowns are not drawn down to the ground.
    assert made.vertices[:, 2].max() > 9


def test_closed_legs_of_a_table_seen_from_above_face_out() -> None:
    made = reconstruct(table_from_above(12_000))
    places = middles(made)
    legs = places[:, 2] < 0.6
    outward = np.where(legs[:, None], (places - np.sign(places) * [0.5, 0.25, 0]) * [1, 1, 0], UP)
    assert legs.sum() > 100
    assert share_against(made, outward) < 0.03
