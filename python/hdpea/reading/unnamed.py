# SPDX-License-Identifier: GPL-3.0-or-later
"""What the columns of a table without names are, if not x, y and z: times, two numbers of a row, or heights."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.numbering import LEAST_ROWS, is_whole, numbers_all, with_fractions
from hdpea.reading.tables import look_like_normals

LEAST_TIME = 1e8
"""Seconds from which what rises is time: that of GPS and of Unix is 1e8 to 2e9 today, while coordinates in metres or
feet, even with the number of their zone in front, stay below."""

TIME_FACTOR = 20
"""How many times the coordinates times are: 4e8 seconds of GPS are that of any northing, but no northing in millimetres
is that of its easting."""

EVEN_SHARE, EVEN_WITHIN = 0.5, 0.1
"""Share of the steps that are within this part of their median where something ticks; of numbers drawn at random and
sorted 7 % are."""

SPREAD_FACTOR = 2
"""How many times wider or narrower than the next three columns times are; those of a ball that is sampled along a
spiral, which rise as evenly, are x."""

LEAST_HEIGHTS = 12
"""Columns from which a table may be heights in rows: fewer are x, y and z with colours, normals and times."""

LIKE, UNLIKE = 0.5, 0.8
"""How far numbers side by side are apart, as a part of how far those in distant rows are: heights of a surface at most
the one, noise at least the other; x and y of points on a ball have 1."""

_quiet = np.errstate(invalid="ignore", over="ignore", divide="ignore")
"""Numbers without a meaning may be infinite."""


@_quiet
def are_timed(table: NDArray[np.float64]) -> bool:
    """Say whether the first column (n, c) is of times: it rises, and is far larger than the three that follow.

    Raises
    ------
    UnreadableInput
        If it rises evenly, as times do, and is spread otherwise than what follows, though it may be x.
    """
    first, others = table[:, 0], table[:, 1:4]
    steps = np.diff(first)
    if len(first) < LEAST_ROWS or not np.isfinite(first).all() or first[0] == first[-1] or steps.min() < 0:
        return False
    is_even = steps.min() > 0 and np.mean(abs(steps / np.median(steps) - 1) < EVEN_WITHIN) >= EVEN_SHARE
    if (is_even or first[0] >= LEAST_TIME) and not (TIME_FACTOR * abs(others) > first[0]).any():
        return True
    width, extents = first[-1] - first[0], np.ptp(others, axis=0)
    is_other = width > SPREAD_FACTOR * extents.max() or SPREAD_FACTOR * width < extents.min()
    if is_even and is_other and with_fractions(table[:, :4]) == 4 and not _has_known_attributes(table):
        hint = "Name all columns in a line above them, as in: t x y z"
        raise UnreadableInput("its first column, which rises evenly, may be times or x.", hint)
    return False


@_quiet
def are_numbered_twice(table: NDArray[np.float64]) -> bool:
    """Say whether the first two columns (n, c) number the rows, as scan and point do, before three of fractions.

    They do if the second counts all rows, or within each scan to no common end, or if over a grid of them the third is
    no surface.

    Raises
    ------
    UnreadableInput
        If they may be x and y as well.
    """
    if len(table) < LEAST_ROWS or table.shape[1] < 5 or with_fractions(table[:, 2:5]) < 3:
        return False
    if not (is_whole(table[:, :2]) and set(table[:, :2].min(axis=0)) <= {0, 1}) or _has_known_attributes(table):
        return False
    first, second, third = table[np.lexsort((table[:, 1], table[:, 0])), :3].T
    begins = np.flatnonzero(np.diff(first, prepend=-1))
    lengths = np.diff([*begins, len(first)])
    steps = np.delete(np.diff(second, prepend=0), begins)
    counts = bool((steps == 1).all() and (second[begins] == second[0]).all())
    is_noise = bool((steps > 0).all() and _apart(third[:-1], third[1:]) > UNLIKE)
    if numbers_all(second) or (counts and (lengths != lengths[0]).any()) or is_noise:
        return True
    hint = "Name all columns in a line above them, as in: row column x y z"
    raise UnreadableInput("its first two columns may be numbers, as of row and column, or x and y.", hint)


@_quiet
def require_points(table: NDArray[np.float64]) -> None:
    """Raise if a table (n, c) is of heights: many columns, and from the first on numbers side by side are alike.

    Raises
    ------
    UnreadableInput
        If it is. Points have no x that is like their y, whatever follows.
    """
    if table.shape[1] < LEAST_HEIGHTS or len(table) < LEAST_ROWS:
        return
    if _apart(table[:, :3], table[:, 1:4]) < LIKE and _apart(table[:, :-1], table[:, 1:]) < LIKE:
        hint = (
            "If so, write ncols, nrows, xllcorner, yllcorner and cellsize above it, and convert it: "
            "gdal_translate -of XYZ dem.asc dem.xyz; if not, write x y z above its columns."
        )
        raise UnreadableInput(f"it looks like a grid, heights in rows of {table.shape[1]}, not points.", hint)


def _has_known_attributes(table: NDArray[np.float64]) -> bool:
    """Say whether columns (n, c) after three, or four, are normals or colours: those before are coordinates then."""
    if table.shape[1] >= 6 and look_like_normals(table[:, 3:6]):
        return True
    return table.shape[1] in {6, 7} and bool(((table[:, -3:] >= 0) & (table[:, -3:] <= 1)).all())


def _apart(left: NDArray[np.float64], right: NDArray[np.float64]) -> float:
    """Return how far numbers are from those at the same place, as a part of that from those half the rows away."""
    far = np.roll(right, len(right) // 2, axis=0)
    return float(np.nansum(abs(left - right)) / np.nansum(abs(left - far)))
