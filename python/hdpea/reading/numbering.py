# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the first column of a table numbers its rows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.reading.tables import look_like_normals

LEAST_ROWS = 10
"""Rows below which numbers that rise by 1 may be chance."""

FRACTION_SHARE = 0.25
"""Share of rows with fractions above which a column is not of whole numbers; a grid of spacing 1/2 has half."""


def counts_rows(column: NDArray[np.float64]) -> bool:
    """Say whether each number (n,) is the one before and 1."""
    return bool(np.array_equal(column, column[:1] + np.arange(len(column))))


def tells_apart(column: NDArray[np.float64]) -> bool:
    """Say whether the numbers (n,) are whole, and no two are the same."""
    return is_whole(column) and len(np.unique(column)) == len(column)


def with_fractions(table: NDArray[np.float64]) -> int:
    """Return how many columns (n, c) have fractions in more than a few rows."""
    return int((np.mean(table != np.floor(table), axis=0) > FRACTION_SHARE).sum())


def are_numbered(table: NDArray[np.float64]) -> bool:
    """Say whether the first column (n, c) numbers the rows: in their order, shuffled, or with gaps before fractions."""
    first, others = table[:, 0], table[:, 1:4]
    if len(first) < LEAST_ROWS:
        return False
    if counts_rows(first) or numbers_all(first):
        return True
    is_sorted = bool((first[1:] > first[:-1]).all() or (first[1:] < first[:-1]).all())
    # Normals in columns 4 to 6 say that those before are coordinates.
    has_normals = table.shape[1] >= 6 and look_like_normals(table[:, 3:6])
    return is_sorted and tells_apart(first) and with_fractions(others) == 3 and not has_normals


def is_whole(numbers: NDArray[np.float64]) -> bool:
    """Say whether all numbers are whole."""
    return bool(np.isfinite(numbers).all() and (numbers == np.floor(numbers)).all())


def numbers_all(column: NDArray[np.float64]) -> bool:
    """Say whether the numbers (n,) are consecutive whole ones in any order."""
    return is_whole(column) and counts_rows(np.sort(column))
