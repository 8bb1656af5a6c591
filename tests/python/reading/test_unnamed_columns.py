# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables without names: what stands before x, y and z is told from them, or refused."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from helpers.files import lines
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading import parse_points

COUNT = 120
POINTS = np.round(sphere_points(COUNT) * [3, 2, 1.5] + [10, 20, 5], 6)
NORMALS = sphere_points(COUNT)
ROWS = np.arange(COUNT)
COLUMNS = np.random.default_rng(1).uniform(size=(COUNT, 12))
SCANS = np.repeat([0, 1, 2], [30, 50, 40])
IN_SCAN = np.concatenate([np.arange(30), np.arange(50), np.arange(40)])
SHUFFLED = np.random.default_rng(2).permutation(COUNT)
SMOOTH = np.stack([ROWS // 12 + 0.3, ROWS % 12 * 0.9 + 0.05, 5 + np.sin(ROWS // 12 / 5 + 0.1)], axis=1)
HEIGHTS = 100 + 3 * np.sin(ROWS[:, None] / 7) * np.cos(np.arange(40) / 9)


def text(*columns: NDArray[np.generic]) -> bytes:
    return lines(np.column_stack(columns)).encode()


@pytest.mark.parametrize(
    ("before", "note"),
    [
        ([SHUFFLED], "Column 1 numbers the rows"),
        ([SHUFFLED + 1001], "Column 1 numbers the rows"),
        ([1.6e9 + ROWS / 10], "Column 1 is taken for times"),
        ([3e8 + np.sort(COLUMNS[:, 0]).round(1)], "Column 1 is taken for times"),  # two returns at one time
        ([302_400 + ROWS * 0.3], "Column 1 is taken for times"),
        ([SCANS, IN_SCAN], "Columns 1 and 2 number the rows"),
        ([SCANS + 1, ROWS], "Columns 1 and 2 number the rows"),
        ([ROWS // 12, ROWS % 12], "Columns 1 and 2 number the rows"),  # of points that are no heights above them
        ([SHUFFLED, SCANS, IN_SCAN], "Columns 2 and 3 number the rows"),
    ],
)
def test_what_stands_before_the_coordinates_is_left_out_and_told(before: list[NDArray[np.float64]], note: str) -> None:
    cloud = parse_points(text(*before, POINTS))
    np.testing.assert_array_equal(cloud.points, POINTS)
    assert any(each.startswith(note) for each in cloud.notes)


def test_what_follows_stays_with_its_points() -> None:
    cloud = parse_points(text(SHUFFLED, POINTS, NORMALS))
    np.testing.assert_array_equal(cloud.points, POINTS)
    np.testing.assert_array_equal(cloud.normals, NORMALS)


@pytest.mark.parametrize(
    ("before", "points", "names"),
    [
        ([ROWS // 12, ROWS % 12], SMOOTH, "row column x y z"),
        ([ROWS % 12, ROWS // 12], SMOOTH, "column row x y z"),
        ([SCANS, SCANS], POINTS, "scan class x y z"),
        ([ROWS / 8], POINTS, "t x y z"),
    ],
)
def test_what_may_be_coordinates_or_not_is_refused_until_it_has_names(
    before: list[NDArray[np.float64]], points: NDArray[np.float64], names: str
) -> None:
    content = text(*before, points)
    with pytest.raises(UnreadableInput, match="may be") as caught:
        parse_points(content)
    assert "Name all columns" in caught.value.hint
    np.testing.assert_array_equal(parse_points(names.encode() + b"\n" + content).points, points)


@pytest.mark.parametrize("heights", [HEIGHTS, HEIGHTS.round(), HEIGHTS[:, :12], HEIGHTS + np.arange(40) / 9])
def test_heights_in_rows_are_no_points_unless_they_are_called_so(heights: NDArray[np.float64]) -> None:
    with pytest.raises(UnreadableInput, match="heights in rows") as caught:
        parse_points(text(heights))
    assert "gdal_translate" in caught.value.hint
    np.testing.assert_array_equal(parse_points(b"x y z\n" + text(heights)).points, heights[:, :3])


@pytest.mark.parametrize("exponent", ["D", "d"])
def test_exponents_of_fortran_are_those_of_all(exponent: str) -> None:
    rows = ["  ".join(f"{number:.16E}" for number in row) for row in POINTS.tolist()]
    np.testing.assert_array_equal(parse_points("\n".join(rows).replace("E", exponent).encode()).points, POINTS)


UTM = np.array([500_000, 5_400_000, 100])
SORTED = POINTS[np.argsort(POINTS[:, 0])]
SPIRAL = np.column_stack([np.linspace(-0.99, 0.99, COUNT), NORMALS[:, :2]])
GRID = np.column_stack([ROWS // 12, ROWS % 12, SMOOTH[:, 2]])


@pytest.mark.parametrize(
    ("points", "after"),
    [
        (POINTS, [COLUMNS]),  # descriptors
        (COLUMNS[:, :3], [COLUMNS[:, 3:]]),  # as large as x, y and z
        (COLUMNS[:, :3], [HEIGHTS]),  # a spectrum
        (POINTS / 1e4, [HEIGHTS * ROWS[:, None]]),
        (COLUMNS[:, :3], [np.floor(256 * COLUMNS)]),
        (SORTED, [COLUMNS[:, 0]]),
        (SORTED + UTM, [COLUMNS[:, :3]]),
        (SORTED[:, [1, 0, 2]], [NORMALS]),
        (SPIRAL, [COLUMNS[:, 0]]),
        (GRID, [NORMALS]),
        (GRID, [COLUMNS[:, :3]]),  # colours
        (GRID, [100 * COLUMNS[:, 0], COLUMNS[:, :3]]),
        (GRID, [COLUMNS[:, 0]]),
        (GRID + UTM, [COLUMNS[:, :2]]),
    ],
)
def test_coordinates_that_come_first_stay_coordinates(
    points: NDArray[np.float64], after: list[NDArray[np.float64]]
) -> None:
    np.testing.assert_array_equal(parse_points(text(points, *after)).points, points)
