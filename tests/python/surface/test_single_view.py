# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds seen from one place or from above are oriented to what saw them; closed ones, and those of many views, not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from helpers import clouds

from hdpea.options import NormalOptions
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.surface.normals import OrientedSurface, oriented_surface
from hdpea.surface.preparation import prepare_surface
from hdpea.surface.signs import cosines

Array = clouds.Array


def found_of(points: Array, sensors: Array | None = None, **chosen: Any) -> OrientedSurface:
    return oriented_surface(points, None, NormalOptions(**chosen), sensors_in_world=sensors)


def seen(cloud: clouds.Cloud, eye: Array) -> clouds.Cloud:
    """Return what is seen of a convex cloud."""
    points, normals = cloud
    towards = eye - points
    facing = cosines(normals, towards) > 0.1 * np.linalg.norm(towards, axis=1)
    return points[facing], normals[facing]


def before_a_camera(points: Array, distance: float = 3) -> Array:
    """Return the points in the frame of a camera: the origin is what sees them, along z."""
    return points + np.array([0, 0, distance])


def terrain(count: int, noise: float = 0) -> Array:
    """Return hills with a cliff between them that has no points."""
    random = np.random.default_rng(4)
    x, y = random.random((2, count))
    z = 0.03 * np.sin(12 * x) + 0.02 * np.cos(9 * y) + 0.2 * (x > 0.5 + 0.03 * np.sin(15 * y))
    return np.stack([x, y, z], axis=1) + random.normal(0, noise, (count, 3))


@pytest.mark.parametrize("noise", [0, 0.003])
def test_what_a_camera_at_the_origin_saw_faces_it(noise: float) -> None:
    eye = np.array([0.0, 0, -3])
    front, normals = seen(clouds.ellipsoid(6000), eye)
    wall = np.array([0, 0, 1.5]) + 3 * (clouds.plane(8000)[0] - 0.5) * [1, 1, 0]  # behind it, with its shadow
    hidden = np.linalg.norm(wall[:, :2] * 3 / 4.5 / [1, 0.6], axis=1) < 1.1
    points = np.vstack([front, wall[~hidden]])
    truth = np.vstack([normals, np.tile([0, 0, -1.0], (np.sum(~hidden), 1))])
    points = points + np.random.default_rng(0).normal(0, noise, points.shape)
    found = found_of(before_a_camera(points))
    assert (found.method, found.from_one_place) == ("viewpoint", True)
    assert (cosines(found.surface.normals, truth) > 0).mean() > 0.995


@pytest.mark.parametrize("noise", [0, 0.002])
def test_a_height_field_faces_up_on_both_sides_of_a_cliff(noise: float) -> None:
    for heights in (1, -1):
        found = found_of(terrain(6000, noise) * [1, 1, heights] + [5e5, 4e6, 300])
        assert (found.method, found.from_one_place) == ("viewpoint", False)
        assert (found.surface.normals[:, 2] > 0).mean() > 0.999


def raster_of_hills() -> Array:
    """Return hills about the z axis, on a grid that is turned."""
    x, y = (grid.ravel() for grid in np.meshgrid(*[np.linspace(-50, 50, 80)] * 2))
    places = np.stack([x - 0.5 * y, 0.5 * x + y], axis=1)
    return np.column_stack([places, 4 * np.sin(x / 20) * np.cos(y / 25)])


def ground_around_a_scanner() -> Array:
    """Return what a scanner 1.8 above flat ground sees of it, up to 12 away, as densely every way."""
    random = np.random.default_rng(0)
    around, ranges = 2 * np.pi * random.random(8000), 1.8 / random.uniform(0.15, 1, 8000)
    away = np.sqrt(ranges**2 - 1.8**2)
    return np.stack([away * np.cos(around), away * np.sin(around), 0.006 * ranges * random.normal(size=8000)], axis=1)


@pytest.mark.parametrize("at", [(0, 0, 120), (10, -5, 200)])
def test_land_on_a_raster_above_the_origin_faces_up(at: tuple[float, float, float]) -> None:
    found = found_of(raster_of_hills() + at)
    assert (found.method, found.from_one_place) == ("viewpoint", False)
    assert (found.surface.normals[:, 2] > 0).all()


@pytest.mark.parametrize("at", [(0, 0, 11), (5, -3, 11)])
def test_so_does_ground_that_a_scanner_elsewhere_saw(at: tuple[float, float, float]) -> None:
    found = found_of(ground_around_a_scanner() + at)
    assert (found.method, found.from_one_place) == ("viewpoint", False)
    assert (found.surface.normals[:, 2] > 0).mean() > 0.999


@pytest.mark.parametrize("degrees", [0, 40])
def test_a_wall_on_the_grid_of_a_camera_faces_it(degrees: float) -> None:
    pixels = np.stack(np.meshgrid(*[np.linspace(-0.4, 0.4, 70)] * 2), axis=-1).reshape(-1, 2)
    tilt = np.tan(np.radians(degrees))
    depths = 3 / (1 - tilt * pixels[:, :1])  # of the plane z = 3 + tilt x
    found = found_of(np.hstack([pixels, np.ones_like(depths)]) * depths)
    assert (found.method, found.from_one_place) == ("viewpoint", True)
    assert (found.surface.normals[:, 2] < 0).all()


@pytest.mark.parametrize("at", [(0, 0, 0), (0, 0, 3), (5, 0, 0), (3e5, 4e6, 10)])
@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_closed_clouds_were_not_seen_from_one_place(shape: str, at: tuple[float, float, float]) -> None:
    points, truth = clouds.CLOSED[shape](3000)
    found = found_of(points + at)
    assert found.computed_sides
    assert (cosines(found.surface.normals, truth) > 0).mean() > 0.99


def test_nor_were_scans_from_two_places() -> None:
    whole = clouds.ellipsoid(8000)
    views = [seen(whole, np.array(eye)) for eye in ([0.0, 0, -3], [2.5, 0, 2])]
    points = np.unique(np.vstack([points for points, _ in views]), axis=0)
    assert found_of(before_a_camera(points)).computed_sides


def test_the_sensors_of_the_file_decide_unasked() -> None:
    points, truth = clouds.sphere(2000)
    for sign in (1, -1):
        found = found_of(points, (1 + sign * 0.5) * points)
        assert (found.method, found.from_one_place) == ("viewpoint", False)
        assert (sign * cosines(found.surface.normals, truth) > 0).all()


def test_what_was_seen_at_a_grazing_angle_follows_the_rest() -> None:
    points, truth = clouds.box(6000)
    sensors = np.tile([0.0, 0, 50], (len(points), 1))  # walls are seen edge-on
    top = points[:, 2] > -0.49
    found = found_of(points[top], sensors[top])
    assert found.from_one_place
    assert (cosines(found.surface.normals, truth[top]) > 0).mean() > 0.99


def test_sensors_that_are_not_all_known_do_not_count() -> None:
    points, truth = clouds.sphere(1000)
    sensors = 0 * points
    sensors[0] = np.nan
    assert (cosines(found_of(points, sensors).surface.normals, truth) > 0).all()


def test_trusted_normals_of_the_file_come_first() -> None:
    points, truth = clouds.plane(1000)
    found = oriented_surface(points, -truth, sensors_in_world=points + np.array([0, 0, 5.0]))
    assert found.method == "file"
    np.testing.assert_array_equal(found.surface.normals, -truth)


def test_that_much_is_missing_is_said() -> None:
    points, _ = seen(clouds.ellipsoid(4000), np.array([0.0, 0, -3]))
    assert any(
        "seen from one place, the origin" in note
        for note in prepare_surface(cleaned_cloud(before_a_camera(points))).notes
    )
    assert not any("one place" in note for note in prepare_surface(cleaned_cloud(clouds.sphere(2000)[0])).notes)
