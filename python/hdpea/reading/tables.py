# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of numbers, and what their columns mean when nobody says so."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput

UNIT_SHARE = 0.95
"""Share of rows of length 1 (or 0) from which three columns are taken for normals."""

_NOT_A_NUMBER = re.compile(r"[-+]?(?:nan\(\w*\)|1\.#(?:IND|QNAN|SNAN|INF|IO|QO|J|R)\d*)(?![^\s,;\"'])", re.IGNORECASE)
"""What Windows writes for NaN and infinity; the short ones where few decimals are written."""

MOST_DIGITS = 18
"""Digits of a count: no file has more points, and of thousands Python makes no number."""

MOST_QUOTED = 60
"""Characters of a line that an error quotes."""


class BadLine(UnreadableInput):
    """A line of a table is not like the others: its number in the file, the line, and what is wrong with it."""

    usual_hint = "Correct the line or delete it; put # before lines that are comments."

    def __init__(self, number: int, line: str, fault: str) -> None:
        content = line.strip()
        quoted = content if len(content) <= MOST_QUOTED else f"{content[:MOST_QUOTED]}..."
        super().__init__(f"line {number} reads {quoted!r}, {fault}.")
        self.number, self.fault = number, fault


def count_of(digits: str) -> int:
    """Return the number of points that a line announces.

    Raises
    ------
    UnreadableInput
        If it has more than ``MOST_DIGITS`` digits.
    """
    digits = digits.strip()
    if len(digits) > MOST_DIGITS:
        hint = "Correct the count or delete it."
        raise UnreadableInput(f"it announces points by a number of {len(digits):,} digits.", hint)
    return int(digits)


def parse_table(lines: Sequence[str], first_line: int = 1, width: int | None = None) -> NDArray[np.float64]:
    """Read lines of numbers separated by blanks as (n, c) float64; blank lines do not count.

    Parameters
    ----------
    lines
        The lines, without comments.
    first_line
        The number of ``lines[0]`` in its file.
    width
        How many numbers each line must hold; default: as many as the first.

    Raises
    ------
    BadLine
        The first that does not hold `width` numbers.
    """
    first = next((line for line in lines if line.strip()), "")
    expected = width or len(first.split())
    if not first:
        return np.empty((0, expected))
    try:
        table = np.loadtxt(lines, dtype=np.float64, comments=None, ndmin=2)
    except ValueError as error:
        plain = [without_words_for_nan(line) for line in lines]
        if plain != list(lines):
            return parse_table(plain, first_line, width)
        raise _first_bad(lines, first_line, expected) from error
    if table.shape[1] != expected:
        raise _first_bad(lines, first_line, expected)
    return table


def _first_bad(lines: Sequence[str], first_line: int, width: int) -> UnreadableInput:
    for number, line in enumerate(lines, first_line):
        tokens = line.split()
        if tokens and len(tokens) != width:
            return BadLine(number, line, f"where {width} numbers are expected")
        bad = next((token for token in tokens if not is_number(token)), None)
        if bad is not None:
            return BadLine(number, line, f"where {bad!r} is no number")
    return UnreadableInput("it is not a table of numbers.")


def without_words_for_nan(text: str) -> str:
    """Return a text with ``nan`` for what Windows writes for it, such as ``-nan(ind)`` and ``1.#QNAN``."""
    return _NOT_A_NUMBER.sub("nan", text) if "(" in text or "1.#" in text else text


def is_number(token: str) -> bool:
    """Say whether `token` is one number, as Python reads them (``nan`` and ``inf`` are)."""
    try:
        float(token)
    except ValueError:
        return False
    return True


def comma_is_decimal(line: str) -> bool:
    """Say whether the commas of this line of numbers are decimal signs, as in ``1,5;2,5;3``."""
    tokens = re.split(r"[;\s]+", line.strip())
    numbers = (re.fullmatch(r"[-+]?\d+(,\d+)?([eE][-+]?\d+)?", token) for token in tokens)
    return len(tokens) >= 3 and "," in line and all(numbers)


def name_columns(table: NDArray[np.float64], normals_expected: bool = False) -> dict[str, NDArray[np.float64]]:
    """Name the columns of a table (n, c) without a header: x, y, z, then normals if three look like it.

    Normals are columns 4 to 6, or the last three (after colours), where nearly every row has
    length 1 or 0; `normals_expected` takes columns 4 to 6 unseen. The others are ``column_4`` and so on.

    Raises
    ------
    UnreadableInput
        If there are fewer than three columns.
    """
    width = table.shape[1]
    if width < 3:
        raise UnreadableInput(f"it has {width} numbers per line, where x, y and z are needed.")
    names = ["x", "y", "z", *(f"column_{i + 1}" for i in range(3, width))]
    for start in sorted({3, max(3, width - 3)}) if width >= 6 and len(table) else ():
        if normals_expected or look_like_normals(table[:, start : start + 3]):
            names[start : start + 3] = ["nx", "ny", "nz"]
            break
    return columns_by_name(names, table)


def columns_by_name(names: Iterable[str], table: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Return the columns of `table` (n, c) under their names."""
    return dict(zip(names, table.T, strict=True))


def look_like_normals(columns: NDArray[np.float64]) -> bool:
    """Say whether nearly all of the rows (n, 3) are of length 1 or 0."""
    with np.errstate(invalid="ignore", over="ignore"):
        lengths = np.linalg.norm(columns, axis=1)
    unusable = ~np.isfinite(lengths) | (lengths == 0)
    return bool(np.mean(unusable | (abs(lengths - 1) < 0.05)) >= UNIT_SHARE)
