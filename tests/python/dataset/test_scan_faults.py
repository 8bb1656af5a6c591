# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of a scan: each does what it says, and nothing else changes."""

from __future__ import annotations

from dataclasses import astuple
from typing import Any

import numpy as np
import pytest
import trimesh
from helpers import meshes
from numpy.typing import NDArray

from hdpea.dataset.options import ScanOptions
from hdpea.dataset.outliers import OUTLIER_BOX
from hdpea.dataset.scan import Scan
from hdpea.dataset.scan_faults import DEPTH_JUMP
from hdpea.dataset.scanning import scan_surface
from hdpea.dataset.sensor_rays import lidar_rays

FAULTS: list[dict[str, Any]] = [
    {"flying": 0.5},
    {"misrotated": 1.0},
    {"misplaced": 0.01},
    {"outliers": 0.05},
    {"step": 0.01},
]
TRUTH = ("surface_points", "normals", "faces")


def scanned(mesh: meshes.Mesh, points: int = 2000, **chosen: Any) -> Scan:
    return scan_surface(*mesh, ScanOptions(points, **chosen))


def two_boxes() -> meshes.Mesh:
    """Return a large box and a small one before its face x, 0.16 away."""
    large, small = trimesh.creation.box((0.1, 0.6, 0.6)), trimesh.creation.box((0.1, 0.2, 0.2))
    both = trimesh.util.concatenate([large.apply_translation((-0.2, 0, 0)), small.apply_translation((0.06, 0, 0))])
    return np.asarray(both.vertices), np.asarray(both.faces)


def views_of(scan: Scan) -> list[NDArray[np.int64]]:
    """Return the rows of each view."""
    _, view = np.unique(scan.sensors.round(9), axis=0, return_inverse=True)
    return [np.flatnonzero(view.ravel() == each) for each in range(view.max() + 1)]


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_changes_the_points_and_not_the_surface_they_were_measured_on(fault: dict[str, Any]) -> None:
    clean, faulty = scanned(two_boxes()), scanned(two_boxes(), **fault)
    assert (faulty.points != clean.points).any()
    same = slice(None) if "outliers" not in fault else (faulty.points == clean.points).all(axis=1)
    for name in TRUTH:
        np.testing.assert_array_equal(getattr(faulty, name)[same], getattr(clean, name)[same])


@pytest.mark.parametrize("fault", [*FAULTS, {"sensor": "lidar"}, {"noise_growth": "linear"}])
def test_the_same_seed_gives_the_same_bytes(fault: dict[str, Any]) -> None:
    one, same, other = (scanned(two_boxes(), **fault, seed=seed) for seed in (1, 1, 2))
    for column, again in zip(astuple(one), astuple(same), strict=True):
        assert column.tobytes() == again.tobytes()
    assert (one.points != other.points).any()


def test_pixels_fly_away_from_the_sensor_along_their_rays_and_only_beside_jumps_in_depth() -> None:
    scan = scanned(two_boxes(), 20_000, noise=0.0, flying=0.5, flying_length=0.04)
    moved = scan.points - scan.surface_points
    rays = scan.surface_points - scan.sensors
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    along = (moved * rays).sum(axis=1)
    np.testing.assert_allclose(moved, along[:, None] * rays, atol=1e-6)  # rays are cast in float32
    assert along.min() > -1e-6
    assert 0.03 < along.max() <= 0.04
    flown = np.flatnonzero(along > 1e-6)
    assert 0 < len(flown) < 0.05 * len(scan.points)
    ranges = np.linalg.norm(scan.surface_points - scan.sensors, axis=1)
    for view in views_of(scan):
        for row in np.intersect1d(flown, view):
            beside = view[np.argsort(-rays[view] @ rays[row])[:20]]
            assert np.ptp(ranges[beside]) > DEPTH_JUMP


def test_nothing_flies_off_a_convex_body() -> None:
    scan = scanned(meshes.icosphere(), 20_000, noise=0.0, flying=1.0)
    np.testing.assert_array_equal(scan.points, scan.surface_points)


def test_misplaced_views_are_rigid_copies_each_moved_in_its_own_way() -> None:
    clean = scanned(meshes.torus(), views=5, noise=0.0)
    faulty = scanned(meshes.torus(), views=5, noise=0.0, misrotated=2.0, misplaced=0.01)
    angles, shifts = [], []
    for rows in views_of(clean):
        # Sensors move with their views, so the rigid motion of the points must bring them along.
        before = np.vstack([clean.points[rows], clean.sensors[rows[:1]]])
        after = np.vstack([faulty.points[rows], faulty.sensors[rows[:1]]])
        left, sizes, right = np.linalg.svd((after - after.mean(axis=0)).T @ (before - before.mean(axis=0)))
        rotation = left @ right
        assert sizes.min() > 0
        np.testing.assert_allclose(after - after.mean(axis=0), (before - before.mean(axis=0)) @ rotation.T, atol=1e-9)
        angles.append(np.degrees(np.arccos((np.trace(rotation) - 1) / 2)))
        shifts.append(after.mean(axis=0) - rotation @ before.mean(axis=0))
    np.testing.assert_allclose(angles, 2, rtol=1e-5)
    assert np.ptp(shifts, axis=0).min() > 0
    assert 0.003 < np.sqrt((np.array(shifts) ** 2).sum(axis=1).mean()) < 0.02


def test_outliers_are_as_many_as_asked_for_within_their_box_and_keep_their_sensors() -> None:
    clean, faulty = scanned(meshes.torus()), scanned(meshes.torus(), outliers=0.05)
    strayed = (faulty.points != clean.points).any(axis=1)
    assert strayed.sum() == 100
    low, high = clean.points.min(axis=0), clean.points.max(axis=0)
    assert (abs(faulty.points - (low + high) / 2) <= OUTLIER_BOX / 2 * (high - low)).all()
    distances = np.linalg.norm(faulty.points[strayed, None] - clean.surface_points, axis=2)
    np.testing.assert_array_equal(faulty.surface_points[strayed], clean.surface_points[distances.argmin(axis=1)])
    np.testing.assert_array_equal(faulty.sensors, clean.sensors)


def test_coordinates_are_multiples_of_the_step_and_nowhere_farther_than_half_of_it() -> None:
    clean, faulty = scanned(meshes.torus()), scanned(meshes.torus(), step=0.004)
    np.testing.assert_allclose(faulty.points / 0.004, np.rint(faulty.points / 0.004), atol=1e-9)
    assert abs(faulty.points - clean.points).max() <= 0.002 + 1e-12


@pytest.mark.parametrize(("growth", "power"), [("none", 0), ("linear", 1), ("quadratic", 2)])
def test_noise_grows_with_the_range_as_asked_for(growth: str, power: int) -> None:
    scan = scanned(meshes.icosphere(), 20_000, noise=0.001, noise_growth=growth, distance=0.7, grazing=60.0)
    rays = scan.surface_points - scan.sensors
    ranges = np.linalg.norm(rays, axis=1)
    cosines = -(scan.normals * rays).sum(axis=1) / ranges
    errors = ((scan.points - scan.surface_points) * rays).sum(axis=1) / ranges * cosines.clip(0.2)
    for part in (ranges < np.quantile(ranges, 0.3), ranges > np.quantile(ranges, 0.7)):
        expected = 0.001 * (ranges[part].mean() / 0.7) ** power
        assert errors[part].std() == pytest.approx(expected, rel=0.05)


def test_a_lidar_sees_rings_as_much_denser_along_as_asked_for() -> None:
    scan = scanned(meshes.icosphere(), 20_000, sensor="lidar", views=1, noise=0.0, ring_ratio=15.0)
    rays = scan.surface_points - scan.sensors
    elevation = np.arcsin(rays[:, 2] / np.linalg.norm(rays, axis=1))
    rings = np.unique(elevation.round(4))
    assert len(rings) < 60
    np.testing.assert_allclose(np.diff(rings), np.diff(rings).mean(), rtol=0.02)
    beams = lidar_rays(scan.sensors[0], 150, 15.0)
    ring = beams.directions[beams.pixels[:, 0] == beams.grid[0] // 2]
    along = np.arccos((ring[1:] * ring[:-1]).sum(axis=1))
    elevations = np.unique(np.arcsin(beams.directions[:, 2]).round(9))
    assert np.diff(elevations).mean() / along.mean() == pytest.approx(15, rel=0.1)
