# SPDX-License-Identifier: GPL-3.0-or-later
"""Scanning: what a sensor outside sees, where it is, to within the noise."""

from __future__ import annotations

from dataclasses import astuple
from typing import Any

import numpy as np
import pytest
from helpers import meshes

from hdpea import _core
from hdpea.dataset import raycasting
from hdpea.dataset.options import ScanOptions
from hdpea.dataset.scan import Scan
from hdpea.dataset.scanning import scan_surface
from hdpea.dataset.sensors import sensor_positions
from hdpea.errors import CannotReconstruct, UsageError

SENSORS = ("views", "turntable")


def scanned(mesh: meshes.Mesh, points: int = 2000, **chosen: Any) -> Scan:
    return scan_surface(*mesh, ScanOptions(points, **chosen))


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize("points", [1, 500, 20_000])
def test_points_are_as_many_as_wanted_and_on_the_faces_they_name(sensor: str, points: int) -> None:
    vertices, faces = mesh = meshes.torus()
    scan = scanned(mesh, points, sensor=sensor)
    assert len(scan.points) == points
    nearest = _core.closest_surface_points(vertices, faces, scan.surface_points)
    assert nearest.distance.max() < 1e-12
    corner = vertices[faces[scan.faces, 0]]
    np.testing.assert_allclose(((scan.surface_points - corner) * scan.normals).sum(axis=1), 0, atol=1e-12)


@pytest.mark.parametrize("sensor", SENSORS)
def test_faces_look_at_the_sensor_and_nothing_stands_between(sensor: str) -> None:
    scan = scanned(meshes.torus(), sensor=sensor)
    towards = scan.sensors - scan.surface_points
    assert ((scan.normals * towards).sum(axis=1) > 0).all()
    on_the_way = scan.surface_points + np.linspace(0, 1, 100)[:, None, None] * towards
    x, y, z = meshes.TORUS_DIAGONAL * np.moveaxis(on_the_way, -1, 0)
    depth = 0.4 - np.hypot(np.hypot(x, y) - 1, z)
    assert depth.max() < 0.01  # the faces lie a little inside the true torus


def test_noise_is_along_the_rays_and_of_the_size_asked_for() -> None:
    scan = scanned(meshes.icosphere(), 20_000, noise=0.002)
    rays = scan.surface_points - scan.sensors
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    moved = scan.points - scan.surface_points
    along = (moved * rays).sum(axis=1)
    np.testing.assert_allclose(moved, along[:, None] * rays, atol=1e-7)  # rays are cast in float32
    facing = -(scan.normals * rays).sum(axis=1)
    nearer = (np.linalg.norm(scan.surface_points - scan.sensors, axis=1) / 1.5) ** 2
    assert (along * facing / nearer)[facing > 0.2].std() == pytest.approx(0.002, rel=0.05)
    assert along[facing < 0.5].std() > 1.5 * along[facing > 0.9].std()


def test_without_noise_points_are_on_the_surface() -> None:
    scan = scanned(meshes.torus(), noise=0.0)
    np.testing.assert_array_equal(scan.points, scan.surface_points)


@pytest.mark.parametrize("sensor", SENSORS)
def test_a_closed_cavity_is_not_seen(sensor: str) -> None:
    _, faces = mesh = meshes.nested_spheres()
    assert scanned(mesh, 20_000, sensor=sensor).faces.max() < len(faces) // 2


def test_a_turntable_hides_the_underside_and_views_all_round_do_not() -> None:
    assert scanned(meshes.box(), sensor="turntable", grazing=90.0).normals[:, 2].min() > -0.5
    assert scanned(meshes.box()).normals[:, 2].min() < -0.5


@pytest.mark.parametrize("sensor", SENSORS)
def test_less_coverage_shows_less(sensor: str) -> None:
    def missing(coverage: float) -> float:
        scan = scanned(meshes.icosphere(), sensor=sensor, coverage=coverage)
        return float(np.linalg.norm(scan.normals.mean(axis=0)))  # 0 if all sides are seen alike

    assert missing(0.1) > 1.5 * missing(1.0)


def test_fewer_grazing_rays_return_the_smaller_the_angle() -> None:
    def grazing(limit: float) -> float:
        scan = scanned(meshes.icosphere(), views=1, grazing=limit)
        rays = scan.surface_points - scan.sensors
        cosines = -(scan.normals * rays).sum(axis=1) / np.linalg.norm(rays, axis=1)
        return float((cosines < 0.3).mean())

    assert grazing(40.0) < 0.7 * grazing(70.0) < 0.7 * grazing(90.0)


@pytest.mark.parametrize("sensor", SENSORS)
def test_sensors_keep_their_distance(sensor: str) -> None:
    positions = sensor_positions(ScanOptions(sensor=sensor, views=30, distance=2.0), np.random.default_rng(0))
    np.testing.assert_allclose(np.linalg.norm(positions, axis=1), 2)


@pytest.mark.parametrize("sensor", SENSORS)
def test_seed_decides(sensor: str) -> None:
    one, same, other = (scanned(meshes.torus(), sensor=sensor, seed=seed) for seed in (1, 1, 2))
    for column, again in zip(astuple(one), astuple(same), strict=True):
        np.testing.assert_array_equal(column, again)
    assert (one.points != other.points).any()


def test_a_mesh_that_is_inside_out_is_refused() -> None:
    vertices, faces = meshes.icosphere()
    with pytest.raises(CannotReconstruct, match="sees too little"):
        scanned((vertices, faces[:, ::-1]))


def test_a_speck_is_refused() -> None:
    vertices, faces = meshes.icosphere()
    with pytest.raises(CannotReconstruct, match="sees too little"):
        scanned((1e-2 * vertices, faces), 40_000)


def test_the_missing_library_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(raycasting, "find_spec", lambda _: None)
    with pytest.raises(UsageError, match="embreex") as told:
        scanned(meshes.icosphere())
    assert "hdpea[dataset]" in told.value.hint
