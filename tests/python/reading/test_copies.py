# SPDX-License-Identifier: GPL-3.0-or-later
"""Points stored twice but for rounding are merged as equal ones are; what is a measured distance apart is not."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import TAU, Array, sphere_points

from hdpea import reconstruct
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.reading.copies import first_copies

COUNT = 3000
GEOREFERENCED = np.array([3.5e5, 5.8e6, 120.0])


def with_copies(points: Array, apart: float) -> Array:
    """Return the points, and the first 100 again, so far away in any direction."""
    return np.vstack([points, points[:100] + apart * sphere_points(100, 7)])


@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
@pytest.mark.parametrize("apart", [3e-16, 1e-13, 1e-10])
def test_copies_are_merged_at_any_scale(scale: float, apart: float) -> None:
    points = np.unique(with_copies(sphere_points(COUNT), apart), axis=0)
    assert len(first_copies(scale * points)) == COUNT


@pytest.mark.parametrize("size", [0.1, 1.0, 100.0])
def test_so_they_are_where_steps_are_larger(size: float) -> None:
    far = GEOREFERENCED + size * sphere_points(COUNT)
    step = np.spacing(5.8e6)
    shifted = far[:100] + np.random.default_rng(1).choice([-2, 0, 2], (100, 3)) * step
    assert len(first_copies(np.unique(np.vstack([far, shifted]), axis=0))) == COUNT


@pytest.mark.parametrize(
    "points",
    [
        pytest.param(sphere_points(COUNT), id="random"),
        pytest.param(with_copies(sphere_points(COUNT), 1e-7), id="pairs"),
        pytest.param(np.stack(np.meshgrid(*[np.arange(15.0)] * 3), -1).reshape(-1, 3), id="grid"),
        pytest.param(1e16 + np.stack(np.meshgrid(*[np.arange(0, 20.0, 2)] * 3), -1).reshape(-1, 3), id="in steps"),
        pytest.param(np.vstack([sphere_points(COUNT), [[1e15, 0, 0]]]), id="beside a far stray"),
        pytest.param(sphere_points(COUNT) * [1, 1, 1e-12], id="flat"),
        pytest.param(np.array([[0.0, 0, 0]]), id="single"),
    ],
)
def test_others_are_not(points: Array) -> None:
    assert len(first_copies(points)) == len(points)


def test_the_order_of_the_points_makes_no_difference() -> None:
    points = with_copies(with_copies(sphere_points(COUNT), 1e-12), 1e-13)
    shuffled = np.random.default_rng(2).permutation(points)
    one, other = (np.unique(each[first_copies(each)], axis=0) for each in (points, shuffled))
    assert len(one) == COUNT
    np.testing.assert_array_equal(one, other)


def test_it_is_told_and_what_belongs_to_the_points_goes_with_them() -> None:
    points = with_copies(sphere_points(COUNT), 1e-13)
    cloud = cleaned_cloud(points, points, attributes={"number": np.arange(len(points))})
    assert cloud.notes == ("Dropped points that occur twice: 100.",)
    assert cloud.counts()["dropped_duplicates"] == 100
    assert len(cloud.points) == COUNT
    kept = cloud.attributes["number"]
    np.testing.assert_array_equal(cloud.points, points[kept])
    np.testing.assert_array_equal(cloud.places(), kept)


def test_a_pipe_is_not_slit_where_its_seam_is_stored_twice() -> None:
    along, around = (each.ravel() for each in np.meshgrid(np.linspace(0, 3, 40), np.linspace(0, TAU, 61)))
    made = reconstruct(np.stack([along, 0.6 * np.cos(around), 0.6 * np.sin(around)], axis=1))
    mesh = made.report.mesh
    assert (mesh.boundary_loops, mesh.components) == (2, 1)
    assert made.report.counts["dropped_duplicates"] == 40
