# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as spreadsheets write them: quotes, empty fields, columns of words, rows that are numbered."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.tables import BadLine, is_number

UNKNOWN = frozenset({"", "na", "n/a", "null", "none", "-", "nan"})
"""Fields, in lower case, where there is no number."""


@dataclass(frozen=True)
class Columns:
    """Columns of numbers (n, c) of a table, which of its `width` columns they are, and how many fields are empty."""

    table: NDArray[np.float64]
    places: list[int]
    width: int
    unknown: int = 0

    def named(self, names: Sequence[str]) -> dict[str, NDArray[np.float64]]:
        """Return the columns of numbers by the names of all columns; one without a name that counts rows is not."""
        named: dict[str, NDArray[np.float64]] = {}
        for place, column in zip(self.places, self.table.T, strict=True):
            if names[place] != f"column_{place + 1}" or not _counts_rows(column):
                named[names[place] if names[place] not in named else f"{names[place]}_{place + 1}"] = column
        return named

    def fits(self, names: int) -> bool:
        """Say whether so many names are those of all columns, or of all but a first one that names or numbers rows."""
        if names == self.width:
            return True
        return 0 not in self.places or (len(self.table) > 1 and _counts_rows(self.table[:, 0]))

    def without_row_numbers(self, notes: list[str]) -> Columns:
        """Return the columns without a first one that counts the rows, if there are three others; note that."""
        if self.table.shape[1] < 4 or len(self.table) < LEAST_ROWS or not _counts_rows(self.table[:, 0]):
            return self
        notes.append(f"Column {self.places[0] + 1} numbers the rows; the next three are taken for x, y and z.")
        return replace(self, table=self.table[:, 1:], places=self.places[1:])

    def notes(self) -> list[str]:
        """Return what a user should know, in sentences."""
        words = [str(place + 1) for place in range(self.width) if place not in self.places]
        notes = [f"Left out, since they hold no numbers: columns {', '.join(words)}."] if words else []
        return [*notes, f"Empty fields, taken for unknown: {self.unknown:,}."] if self.unknown else notes


LEAST_ROWS = 10
"""Rows below which numbers that rise by 1 may be chance."""


def _counts_rows(column: NDArray[np.float64]) -> bool:
    return bool(np.array_equal(column, column[:1] + np.arange(len(column))))


def parse_columns(lines: Sequence[str], separator: str, first_line: int) -> Columns:
    """Read lines of fields, among which may be words, as columns; a column is of what its first field is that is known.

    Raises
    ------
    BadLine
        The first that has more or fewer fields, or a word among numbers.
    UnreadableInput
        If there are fewer than three columns of numbers.
    """
    read = csv.reader(lines, delimiter=separator) if separator else map(str.split, lines)
    rows = [(number, [each.strip(" \"'") for each in row]) for number, row in enumerate(read, first_line) if row]
    rows = [(number, row) for number, row in rows if any(row)]
    width = len(rows[0][1])
    for number, row in rows:
        if len(row) != width:
            raise BadLine(number, (separator or " ").join(row), f"where {width} fields are expected")
    found, places, unknown = [], [], 0
    for place in range(width):
        fields = [row[place] for _, row in rows]
        known = next((each for each in fields if each.lower() not in UNKNOWN), "")
        if not is_number(known):
            continue
        try:
            column = np.array(fields, np.float64)
        except ValueError:
            filled = ["nan" if each.lower() in UNKNOWN else each for each in fields]
            unknown += sum(each == "" for each in fields)
            bad = next((i for i, each in enumerate(filled) if not is_number(each)), None)
            if bad is not None:
                number, row = rows[bad]
                fault = f"where field {place + 1}, {fields[bad]!r}, is no number"
                raise BadLine(number, (separator or " ").join(row), fault) from None
            column = np.array(filled, np.float64)
        found.append(column)
        places.append(place)
    if len(found) < 3:
        raise UnreadableInput(f"it has {len(found)} numbers per line, where x, y and z are needed.")
    return Columns(np.stack(found, axis=1), places, width, unknown)
