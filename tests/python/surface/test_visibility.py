# SPDX-License-Identifier: GPL-3.0-or-later
"""Sensors count where they can have seen the points, and are told not to where other points lie between."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import Array, sphere_points

from hdpea.surface.normals import OrientedSurface, oriented_surface

FAR = np.array([4.0, 1.0, 2.0])
ELSEWHERE = np.array([5e5, 5e6, 100.0])


def peanut(count: int = 6000) -> tuple[Array, Array]:
    """Return two balls that meet, and their normals."""
    ball = sphere_points(count // 2, 1)
    points, normals = (
        np.vstack([ball - [0.8, 0, 0], ball * [-1, 1, 1] + [0.8, 0, 0]]),
        np.vstack([ball, ball * [-1, 1, 1]]),
    )
    outside = abs(points[:, 0]) > 0.001
    outside &= (points[:, 0] < 0) == (np.arange(len(points)) < count // 2)
    return points[outside], normals[outside]


def seen(points: Array, sensors: Array) -> OrientedSurface:
    """Return points (n, 3), each with its sensor, with normals."""
    return oriented_surface(points, sensors_in_world=np.ascontiguousarray(np.broadcast_to(sensors, points.shape)))


def share_along(found: OrientedSurface, normals: Array) -> float:
    """Return the share of the normals found that point along the true ones: in the valley some lie across both."""
    return float(((found.surface.normals * normals).sum(axis=1) > 0).mean())


@pytest.mark.parametrize("wrong", ["one for all", "of others", "another frame"])
def test_sensors_that_cannot_have_seen_the_points_do_not_count(wrong: str) -> None:
    points, normals = peanut()
    theirs = points + 3 * normals
    sensors = {
        "one for all": FAR,
        "of others": np.random.default_rng(0).permutation(theirs),
        "another frame": theirs - ELSEWHERE,
    }
    found = seen(points, sensors[wrong])
    assert found.sensors_refused
    assert not found.from_one_place
    assert share_along(found, normals) > 0.99


def test_sensors_that_saw_the_points_count() -> None:
    points, normals = peanut()
    around = seen(points, points + 3 * normals)
    front = points[(normals @ FAR > 0) & (((FAR - points) * normals).sum(axis=1) > 0)]
    for found in (around, seen(front, FAR)):
        assert not found.sensors_refused
        assert found.method == "viewpoint"


@pytest.mark.filterwarnings("error")
def test_a_sensor_may_be_very_far_away() -> None:
    assert seen(sphere_points(1000), np.array([1e200, 0, 0])).sensors_refused


def test_a_scanner_within_saw_what_surrounds_it() -> None:
    points, normals = peanut()
    found = seen(points, np.array([0.5, 0, 0]))
    assert not found.sensors_refused
    assert share_along(found, -normals) > 0.99


def wall_through_leaves() -> Array:
    """Return what a scanner 10 before a wall sees of it, and of leaves of a few points each that hang before it."""
    random = np.random.default_rng(0)
    rays = np.column_stack([random.uniform(-0.3, 0.3, (8000, 2)), np.ones(8000)])
    depths = np.full(len(rays), 10.0)
    for leaf in np.column_stack([random.uniform(-0.3, 0.3, (1500, 2)), random.uniform(6, 8, 1500)]):
        at_leaf = np.linalg.norm(rays[:, :2] - leaf[:2], axis=1) * leaf[2] < 0.04
        depths[at_leaf] = np.minimum(depths[at_leaf], leaf[2])
    return rays * depths[:, None]


def test_sensors_see_through_a_hedge() -> None:
    points = wall_through_leaves()
    aside = np.array([5.0, 0, 0])
    found = seen(points + aside, aside)
    assert not found.sensors_refused
    assert share_along(found, -points) > 0.95


def test_layers_of_one_surface_hide_nothing() -> None:
    points = sphere_points(6000, 1)
    half = points[points[:, 2] > 0.2]
    layers = np.vstack([half, half * 1.04])
    assert not seen(layers, np.array([0, 0, 9.0])).sensors_refused
