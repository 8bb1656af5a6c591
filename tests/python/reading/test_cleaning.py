# SPDX-License-Identifier: GPL-3.0-or-later
"""What is dropped and counted when a cloud is read."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cleaning import cleaned, first_occurrences, unit_or_zero
from hdpea.reading.cloud import PointCloud


def test_points_that_are_not_finite_are_dropped_and_counted() -> None:
    points = sphere_points(5)
    points[1, 0] = np.nan
    points[3, 2] = np.inf
    cloud = cleaned(PointCloud(points, attributes={"index": np.arange(5)}))
    assert cloud.attributes["index"].tolist() == [0, 2, 4]
    assert (cloud.dropped_non_finite, cloud.dropped_duplicates) == (2, 0)


def test_the_first_of_equal_points_stays() -> None:
    points = sphere_points(4)[[0, 1, 0, 2, 1, 0]]
    cloud = cleaned(PointCloud(points, attributes={"index": np.arange(6)}))
    assert cloud.attributes["index"].tolist() == [0, 1, 3]
    assert cloud.dropped_duplicates == 3


@given(
    st_numpy.arrays(np.float64, st.tuples(st.integers(1, 30), st.just(3)), elements=st.sampled_from([-0.0, 0.0, 1.0]))
)
def test_first_occurrences_agree_with_a_plain_loop(rows: NDArray[np.float64]) -> None:
    seen: dict[tuple[float, ...], int] = {}
    for index, row in enumerate(rows.tolist()):
        seen.setdefault(tuple(row), index)
    assert first_occurrences(rows).tolist() == list(seen.values())


def test_millimetres_at_ten_million_metres_are_not_duplicates() -> None:
    points = 1e7 + 1e-3 * np.arange(300.0).reshape(100, 3)
    cloud = cleaned(PointCloud(points))
    np.testing.assert_array_equal(cloud.points, points)


def test_unusable_normals_are_zero_and_counted() -> None:
    normals = 2 * sphere_points(4)
    normals[0], normals[1] = 0, np.nan
    cloud = cleaned(PointCloud(sphere_points(4), normals))
    assert cloud.normals is not None
    assert cloud.normals.any(axis=1).tolist() == [False, False, True, True]
    np.testing.assert_allclose(np.linalg.norm(cloud.normals[2:], axis=1), 1)
    assert cloud.unusable_normals == 2


@pytest.mark.parametrize("normal", [0.0, np.nan, np.inf])
def test_a_cloud_without_one_usable_normal_has_none(normal: float) -> None:
    cloud = cleaned(PointCloud(sphere_points(4), np.full((4, 3), normal)))
    assert cloud.normals is None
    assert cloud.unusable_normals == 4


@given(st_numpy.arrays(np.float64, (5, 3)))
def test_normals_have_length_one_or_zero_whatever_comes(vectors: NDArray[np.float64]) -> None:
    normals = unit_or_zero(vectors)
    np.testing.assert_array_equal(unit_or_zero(normals), normals)
    lengths = np.linalg.norm(normals, axis=1)
    assert np.all((abs(lengths - 1) < 1e-6) | (lengths == 0))


@pytest.mark.parametrize("points", [np.empty((0, 3)), np.full((2, 3), np.nan)])
def test_nothing_left_is_an_error(points: NDArray[np.float64]) -> None:
    with pytest.raises(UnreadableInput, match="point"):
        cleaned(PointCloud(points))
