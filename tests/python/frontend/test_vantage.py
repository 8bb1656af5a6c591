# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a scanner stood in the origin: found of lidar frames, in any turn and unit, and of no thing around it."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from helpers.raw_clouds import lidar_frame
from numpy.typing import NDArray

from hdpea.frontend.vantage import LIKELY, TAKEN, with_sensor_found
from hdpea.reading.cloud import PointCloud

Points = NDArray[np.float64]

TURNED = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3))).Q


def spindle() -> Points:
    """Return a long thing about the origin, even as seen from there."""
    sphere = sphere_points(8000)
    return sphere * (1 + 4 * sphere[:, 2:] ** 4)


def room() -> Points:
    """Return the walls of a room, even as seen from its middle."""
    sphere = sphere_points(20_000)
    return sphere / (abs(sphere) / [6, 5, 2]).max(axis=1, keepdims=True)


@pytest.mark.parametrize("rings", [16, 64])
@pytest.mark.parametrize("unit", [1.0, 1e3])
def test_a_lidar_frame_has_its_sensor_in_the_origin(rings: int, unit: float) -> None:
    points = unit * lidar_frame(rings) @ TURNED.T
    found = with_sensor_found(PointCloud(points))
    assert found.notes == (TAKEN,)
    assert np.array_equal(found.sensors(), np.zeros_like(points))


def test_nor_do_noise_and_gaps_hide_it() -> None:
    random = np.random.default_rng(0)
    points = lidar_frame(64)
    points = points[(np.arctan2(points[:, 1], points[:, 0]) > -2) & (random.random(len(points)) > 0.3)]
    assert with_sensor_found(PointCloud(points * random.normal(1, 1e-3, (len(points), 1)))).notes == (TAKEN,)


def test_rays_without_a_return_do_not_hide_it() -> None:
    points = np.vstack([lidar_frame(64), np.zeros((1, 3))])
    found = with_sensor_found(PointCloud(points))
    assert found.notes == (TAKEN,)
    assert np.array_equal(found.sensors(), np.zeros_like(points))


@pytest.mark.parametrize(
    "points",
    [
        sphere_points(5000),
        sphere_points(5000) * [1, 2, 5],
        sphere_points(8000)[sphere_points(8000)[:, 2] > -0.5],
        lidar_frame(64) + np.array([100, 0, 0]),
    ],
    ids=["ball", "stretched", "cup", "elsewhere"],
)
def test_a_thing_around_the_origin_was_not_seen_from_there(points: Points) -> None:
    cloud = PointCloud(points)
    assert with_sensor_found(cloud) is cloud


@pytest.mark.parametrize("points", [room(), spindle()], ids=["room", "thing"])
def test_what_is_even_all_around_the_origin_may_be_a_room_or_a_thing(points: Points) -> None:
    found = with_sensor_found(PointCloud(points))
    assert found.notes == (LIKELY,)
    assert found.sensors() is None


def test_sensors_of_the_file_stay() -> None:
    points = lidar_frame(16)
    cloud = PointCloud(points, attributes={"sensor": np.ones_like(points)})
    assert with_sensor_found(cloud) is cloud
