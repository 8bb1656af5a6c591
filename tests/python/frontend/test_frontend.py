# SPDX-License-Identifier: GPL-3.0-or-later
"""The front end on small known clouds: strays, scan lines, and that nothing depends on frame, unit or order."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds
from helpers.clouds import sphere_points
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend import classify
from hdpea.frontend.cleaning import STRAY, surface_cloud
from hdpea.frontend.heaps import in_heaps, missing_with_heaps
from hdpea.options import CleaningOptions
from hdpea.reading.cloud import PointCloud

Points = NDArray[np.float64]


def scan_lines(lines: int, density: float) -> Points:
    """Return circles of latitude of the unit sphere, along which points are `density` times nearer than across."""
    circles = []
    for angle in (np.arange(lines) + 0.5) * np.pi / lines:
        count = max(int(2 * np.pi * np.sin(angle) * lines / np.pi * density), 3)
        around = np.arange(count) * 2 * np.pi / count + 0.7 * angle
        ring = np.sin(angle) * np.cos(around), np.sin(angle) * np.sin(around), np.full(count, np.cos(angle))
        circles.append(np.stack(ring, axis=1))
    return np.vstack(circles)


def with_strays(count: int) -> tuple[Points, Points]:
    """Return a sphere, and strays in the cube around it that lie off the sphere by more than four spacings."""
    places = np.random.default_rng(1).uniform(-1.5, 1.5, size=(4 * count, 3))
    off = abs(np.linalg.norm(places, axis=1) - 1) > 4 * np.sqrt(4 * np.pi / 4000)
    return sphere_points(4000), places[off][:count]


def rotation() -> Points:
    return np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3))).Q


def test_an_even_cloud_is_kept_as_it_is() -> None:
    found = classify(sphere_points(4000))
    assert found.strays.mean() <= 1e-3
    assert found.on_lines == 0
    assert np.array_equal(found.kept, ~found.strays)


def test_strays_that_keep_close_company_are_told_from_others() -> None:
    sphere, strays = with_strays(200)
    points = np.vstack([sphere, sphere[:1000] * [1, 1, 0.01] + [0, 0, 3], strays + np.array([0, 6, 0])])
    dropped = np.arange(len(points)) >= len(sphere)
    heaped = in_heaps(points, _core.nearest_neighbors(points, 8), dropped)
    assert heaped[4000:5000].mean() > 0.5
    assert not heaped[:4000].any()
    assert not heaped[5000:].any()
    assert missing_with_heaps(int(heaped.sum()), len(points))
    assert not missing_with_heaps(int(heaped.sum()), 100 * len(points))


@pytest.mark.parametrize("deviation", [0.3, 1.0, 1.5])
def test_noise_is_not_taken_for_strays(deviation: float) -> None:
    noise = 1 + deviation * np.sqrt(4 * np.pi / 4000) * np.random.default_rng(6).normal(size=(4000, 1))
    assert classify(noise * sphere_points(4000)).strays.mean() <= 5e-3


def test_two_sides_of_a_thin_plate_are_surface() -> None:
    flat = np.random.default_rng(3).random((4000, 2))
    plate = np.column_stack([flat, np.arange(4000) % 2 * 0.03])
    kept = classify(plate).kept
    inside = (abs(flat - 0.5) < 0.45).all(axis=1)
    assert kept[inside].all()
    # At the open rim, where they are a strip of two lines, a few may go.
    assert kept.mean() >= 1 - 2e-3


@pytest.mark.parametrize("far", [5.0, 100.0, 1e6])
def test_one_stray_is_found_however_far_away(far: float) -> None:
    found = classify(np.vstack([sphere_points(4000), [[far, 0, 0]]]))
    assert found.strays[-1]
    assert found.strays[:-1].mean() <= 1e-3


@pytest.mark.parametrize("count", [12, 40, 400])
def test_all_strays_are_found_also_where_they_are_each_others_neighbors(count: int) -> None:
    surface, strays = with_strays(count)
    found = classify(np.vstack([surface, strays]))
    assert found.strays[len(surface) :].all()
    assert found.strays[: len(surface)].mean() <= 1e-3


def test_a_sheet_far_sparser_than_what_it_borders_on_is_kept() -> None:
    random = np.random.default_rng(3)
    dense = random.random((6000, 3)) * [1, 1, 0]
    sparse = random.random((500, 3)) * [3, 1, 0] + [1, 0, 0]
    strays = random.random((40, 3)) * [4, 1, 1] + [0, 0, 0.3]
    found = classify(np.vstack([dense, sparse, strays])).strays
    assert found[-len(strays) :].all()
    assert found[: -len(strays)].sum() <= 10  # at the rim; without a look at sheets, 100


def test_the_far_side_of_a_thin_wall_is_kept_where_it_was_seen_at_a_slant() -> None:
    random, thickness = np.random.default_rng(3), 0.05
    near, far = random.random((10_000, 3)) * [2, 1, 0], random.random((5000, 3)) * [1, 1, 0] - [0, 0, thickness]
    slant = random.random((833, 3)) * [1, 1, 0] + [1, 0, -thickness]
    wall = np.vstack([near, far, slant]) + random.normal(0, 0.001, (15_833, 3))
    strays = random.uniform(-0.5, 0.5, (200, 3)) * [3, 2, 2] + [1, 0.5, 0]
    strays = strays[abs(strays[:, 2]) > 0.12]
    found = classify(np.vstack([wall, strays])).strays
    assert found[-len(strays) :].all()
    assert found[:15_000].sum() <= 2
    assert found[15_000:15_833].sum() <= 80  # 408, where strays are not held against each other


def test_a_sheet_far_from_everything_is_dropped() -> None:
    random = np.random.default_rng(3)
    dense, far = random.random((6000, 3)) * [1, 1, 0], random.random((40, 3)) * [30, 30, 0] + [60, 0, 0]
    found = classify(np.vstack([dense, far])).strays
    assert found[-len(far) :].all()
    assert found[: -len(far)].sum() <= 10


@pytest.mark.parametrize("far", [20.0, 1000.0])
def test_three_strays_together_are_no_sheet_with_the_edge_of_a_box(far: float) -> None:
    points, _ = clouds.box(3000, (1, 2, 0.5))
    strays = [far, 0, 0.3 * far] + 0.001 * far * np.random.default_rng(2).normal(size=(3, 3))
    found = classify(np.vstack([points, strays])).strays
    assert found[-3:].all()
    assert not found[:-3].any()


def test_of_points_on_lines_those_are_kept_that_the_gaps_need() -> None:
    cloud = scan_lines(40, density=15)
    found = classify(cloud)
    assert found.on_lines > 0.9
    assert not found.strays.any()
    # From as many along a line as there are gaps, to seven times as many.
    even = len(cloud) / 15
    assert even <= found.kept.sum() <= 7 * even
    assert np.median(found.spacing) == pytest.approx(np.pi / 40, rel=0.35)


def test_the_spacing_of_an_even_cloud_is_the_side_of_each_points_square() -> None:
    assert np.median(classify(sphere_points(4000)).spacing) == pytest.approx(np.sqrt(4 * np.pi / 4000), rel=0.1)


def test_wires_are_kept_whole() -> None:
    along = np.linspace(0, 1, 2000)
    wire = np.column_stack([np.cos(9 * along), np.sin(9 * along), 3 * along])
    assert classify(wire).kept.mean() > 0.99


@pytest.mark.parametrize("kind", ["strays", "lines"])
def test_frame_unit_and_order_make_no_difference(kind: str) -> None:
    cloud = np.vstack(with_strays(40)) if kind == "strays" else np.vstack([scan_lines(30, 15), [[9.0, 0, 0]]])
    # So that no two points are equally far from others.
    cloud = cloud + np.random.default_rng(4).normal(scale=1e-3, size=cloud.shape)
    found = classify(cloud)
    order = np.random.default_rng(5).permutation(len(cloud))
    moved = classify(1000 * cloud[order] @ rotation().T + [5e3, -2e3, 1e3])
    assert np.array_equal(moved.strays, found.strays[order])
    assert np.mean(moved.kept == found.kept[order]) > 0.999
    assert moved.spacing == pytest.approx(1000 * found.spacing[order], rel=1e-3)


def test_few_points_are_taken_as_they_are() -> None:
    found = classify(np.vstack([sphere_points(50), [[100.0, 0, 0]]]))
    assert found.kept.all()
    assert not found.spacing.any()


def test_cleaning_counts_what_it_drops_and_keeps_the_order() -> None:
    surface, strays = with_strays(40)
    cloud = PointCloud(np.vstack([strays, surface]), attributes={"row": np.arange(len(strays) + len(surface))})
    cleaned = surface_cloud(cloud)
    rows = cleaned.cloud.attributes["row"]
    assert (np.diff(rows) > 0).all()
    assert rows[0] >= len(strays)
    strays = cleaned.counts()["dropped_strays"]
    assert strays + len(rows) == len(cloud.points)
    assert any(f"{strays:,}" in note for note in cleaned.notes)


def test_strays_make_no_difference_to_the_order_in_space() -> None:
    surface = PointCloud(sphere_points(10_100))
    cleaned = surface_cloud(PointCloud(np.vstack([surface.points, [[9.0, 0, 0]]])))
    left = cleaned.cloud.points
    ordered = cleaned.in_order_of_space()
    np.testing.assert_array_equal(ordered.points, surface_cloud(PointCloud(left)).in_order_of_space().points)
    assert np.array_equal(np.sort(ordered.places()), cleaned.cloud.places())
    steps = [np.linalg.norm(np.diff(each, axis=0), axis=1).mean() for each in (left, ordered.points)]
    assert steps[1] < 0.2 * steps[0]


def test_what_is_dropped_is_kept_apart_with_the_reason() -> None:
    lines = np.vstack([scan_lines(30, 15), [[9.0, 0.0, 0.0]]])
    cleaned = surface_cloud(PointCloud(lines))
    counts = cleaned.counts()
    assert counts["dropped_on_lines"] > 1000
    assert counts["dropped_strays"] >= 1
    assert sum(counts.values()) == len(cleaned.dropped.points) == len(lines) - len(cleaned.cloud.points)
    assert len(cleaned.on_surface.points) == len(lines) - counts["dropped_strays"]
    assert (cleaned.dropped.reasons[(cleaned.dropped.points == [9, 0, 0]).all(axis=1)] == STRAY).all()


def test_many_strays_are_said_to_be_many() -> None:
    few, many = (surface_cloud(PointCloud(np.vstack(with_strays(count)))) for count in (40, 400))
    assert "of all" not in " ".join(few.notes)
    assert "9% of all" in " ".join(many.notes)


def test_nothing_is_dropped_if_it_is_not_wanted() -> None:
    cloud = PointCloud(np.vstack(with_strays(40)))
    cleaned = surface_cloud(cloud, CleaningOptions(outliers="none"))
    assert cleaned.cloud is cleaned.on_surface is cloud
    assert len(cleaned.dropped.points) == 0
    assert cleaned.points_shown == len(cloud.points)
