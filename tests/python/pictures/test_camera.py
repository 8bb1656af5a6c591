# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera: the right way up, in front of the side that was scanned, and turning with it."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from hdpea.pictures.camera import choose_view, choose_view_of_points, mean_sight
from hdpea.pictures.picture import Camera

Array = NDArray[np.float64]
Mesh = tuple[Array, NDArray[np.int64]]

X, Y, Z = np.eye(3)
RIGHT, UP, TOWARD = range(3)


def wall(facing: Array, up: Array, centre: Array) -> Mesh:
    """Return a wall that bulges a little, 2 wide and 2 high, whose normals point along `facing`, by and large."""
    across = np.linspace(-1, 1, 9)
    u, v = (grid.ravel() for grid in np.meshgrid(across, across, indexing="ij"))
    points = np.outer(u, np.cross(up, facing)) + np.outer(v, up) - 0.1 * np.outer(u**2 + v**2, facing)
    corner = np.arange(81).reshape(9, 9)[:-1, :-1].ravel()
    faces = np.vstack(
        [np.column_stack([corner, corner + 9, corner + 10]), np.column_stack([corner, corner + 10, corner + 1])]
    )
    return points + centre, faces


def cone(up: int) -> Mesh:
    """Return a cone standing on its base, whose axis is coordinate axis `up`."""
    mesh = trimesh.creation.cone(0.5, 1.0)
    vertices = np.asarray(mesh.vertices) if up == 2 else np.asarray(mesh.vertices)[:, [1, 2, 0]]
    return vertices, np.asarray(mesh.faces)


def turn_about_z(degrees: float) -> Array:
    angle = np.radians(degrees)
    return np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])


@pytest.mark.parametrize("facing", [X, -X, Y, -Y])
def test_a_wall_is_looked_at_from_the_side_it_faces_with_z_up(facing: Array) -> None:
    view = choose_view(*wall(facing, Z, np.array([3.0, -2, 5])))
    np.testing.assert_allclose(view @ view.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(view) == pytest.approx(1)
    assert view[TOWARD] @ facing > 0.7
    assert view[UP, 2] > 0.7
    assert view[RIGHT, 2] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("degrees", [20, 90, 200])
def test_turning_a_scan_about_z_turns_the_camera_with_it(degrees: float) -> None:
    turn = turn_about_z(degrees)
    vertices, faces = wall(X, Z, np.zeros(3))
    vertices[:, 0] += 0.3 * vertices[:, 2]  # leans back
    np.testing.assert_allclose(choose_view(vertices @ turn.T, faces) @ turn, choose_view(vertices, faces), atol=1e-12)


def test_turning_points_with_their_sensors_about_z_turns_the_camera_with_them() -> None:
    turn = turn_about_z(70)
    points = np.random.default_rng(0).normal(size=(500, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    sensors = np.tile([6.0, 2, 3], (500, 1))
    view = choose_view_of_points(points, points, mean_sight(points, sensors))
    turned = choose_view_of_points(points @ turn.T, points @ turn.T, mean_sight(points @ turn.T, sensors @ turn.T))
    np.testing.assert_allclose(turned @ turn, view, atol=1e-12)
    assert view[TOWARD] @ sensors[0] / np.linalg.norm(sensors[0]) > 0.7


def test_terrain_is_seen_from_obliquely_above_and_a_ceiling_from_below() -> None:
    terrain, ceiling = (choose_view(*wall(side * Z, Y, np.zeros(3))) for side in (1, -1))
    assert 0.7 < terrain[TOWARD, 2] < 0.9
    assert -0.9 < ceiling[TOWARD, 2] < -0.7
    assert terrain[UP, 2] > 0.4
    assert ceiling[UP, 2] > 0.4


def test_before_a_depth_camera_at_the_origin_y_points_down() -> None:
    view = choose_view(*wall(-Z, Y, np.array([0.0, 0, 3])))
    assert view[TOWARD, 2] < -0.7
    assert view[UP, 1] < -0.7
    assert view[RIGHT, 0] > 0.7  # x of the depth camera is to the right


@pytest.mark.parametrize("up", [1, 2])
def test_a_shape_stands_on_its_base(up: int) -> None:
    assert choose_view(*cone(up))[UP, up] > 0.8


@pytest.mark.parametrize("up", [1, 2])
def test_a_shape_stands_on_its_base_though_no_scanner_saw_that(up: int) -> None:
    vertices, faces = cone(up)
    centres = vertices[faces].mean(axis=1)
    sides = faces[centres[:, up] > vertices[:, up].min() + 1e-9]
    tall = vertices * np.where(np.arange(3) == up, 4, 1)
    assert choose_view(tall, sides)[UP, up] > 0.8


def test_what_rests_on_no_side_more_than_on_others_has_z_up() -> None:
    for seed in range(5):
        points = np.random.default_rng(seed).normal(size=(1000, 3))
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        assert choose_view_of_points(points, points)[UP, 2] > 0.9


def test_a_closed_shape_is_looked_at_from_its_sensor_and_from_the_front_if_they_were_all_around() -> None:
    vertices, faces = cone(2)
    sensor = 10 * X
    assert choose_view(vertices, faces, mean_sight(vertices, np.tile(sensor, (len(vertices), 1))))[TOWARD, 0] > 0.7
    around = mean_sight(np.zeros((4, 3)), 5 * np.array([X, Y, -X, -Y]))
    np.testing.assert_array_equal(choose_view(vertices, faces, around), choose_view(vertices, faces))
    assert choose_view(vertices, faces)[TOWARD, 1] < -0.7


def test_sensors_whose_positions_are_unknown_do_not_count() -> None:
    points, sensors = np.zeros((3, 3)), np.array([2 * X, [np.nan] * 3, np.zeros(3)])
    np.testing.assert_array_equal(mean_sight(points, sensors), X)
    assert mean_sight(points, None) is None
    assert mean_sight(points[1:], sensors[1:]) is None


def test_points_are_looked_at_as_their_mesh_is() -> None:
    vertices = np.array([[0.0, 0, 0], [0, 0, 1], [1, 0, 0]])
    mesh, points = (
        Camera.before(vertices, np.array([[0, 1, 2]])),
        Camera.before_points(vertices, np.tile(Y, (3, 1))),
    )
    np.testing.assert_allclose(points.view_from_world, mesh.view_from_world, atol=1e-12)
    np.testing.assert_allclose(points.to_view(vertices), mesh.to_view(vertices), atol=1e-12)
