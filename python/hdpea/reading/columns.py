# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables as spreadsheets write them: quotes, empty fields, columns of words, rows that are numbered."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.names import coordinates_among
from hdpea.reading.numbering import LEAST_ROWS, are_numbered, counts_rows, tells_apart, with_fractions
from hdpea.reading.tables import BadLine, is_number
from hdpea.reading.unnamed import are_numbered_twice, are_timed

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
        """Return the columns of numbers by the names of all columns; one without a name that numbers rows is not."""
        named: dict[str, NDArray[np.float64]] = {}
        for place, column in zip(self.places, self.table.T, strict=True):
            numbers = counts_rows(column) or (place == 0 and tells_apart(column))
            if names[place] != f"column_{place + 1}" or not numbers:
                named[names[place] if names[place] not in named else f"{names[place]}_{place + 1}"] = column
        return named

    def fits(self, names: Sequence[str]) -> bool:
        """Say whether these plain names are those of all columns, or of all but a first one that names rows."""
        if len(names) != self.width - 1:
            return len(names) == self.width
        first = self.table[:, 0]
        if 0 not in self.places or (len(first) > 1 and counts_rows(first)):
            return True
        if len(coordinates_among(names)) < 3 or len(first) < LEAST_ROWS or not tells_apart(first):
            return False
        # Some rows of a longer table, as R and pandas write them, unless the names fit as well without a shift.
        at = min(names.index(name) for name in coordinates_among(names))
        unshifted = self.table[:, [i for i, place in enumerate(self.places) if place == at]]
        return with_fractions(self.table[:, 1:]) >= 3 and not with_fractions(unshifted)

    def without_row_numbers(self, notes: list[str], told: bool) -> Columns:
        """Return the columns without a first one that numbers the rows, if there are three others; note that.

        It does if ``are_numbered`` says so, or if the file has `told` it.
        """
        if self.table.shape[1] < 4 or not (self.places[0] == 0 if told else are_numbered(self.table)):
            return self
        notes.append(f"Column {self.places[0] + 1} numbers the rows; the next three are taken for x, y and z.")
        return self._from(1)

    def without_times(self, notes: list[str]) -> Columns:
        """Return the columns without a first one of times, or a first two of scan and point; note that.

        Raises
        ------
        UnreadableInput
            If they may be coordinates as well.
        """
        if self.table.shape[1] >= 4 and are_timed(self.table):
            notes.append(f"Column {self.places[0] + 1} is taken for times, the next three for x, y and z.")
            return self._from(1)
        if are_numbered_twice(self.table):
            first, second = (place + 1 for place in self.places[:2])
            notes.append(f"Columns {first} and {second} number the rows; the next three are taken for x, y and z.")
            return self._from(2)
        return self

    def _from(self, start: int) -> Columns:
        return replace(self, table=self.table[:, start:], places=self.places[start:])

    def notes(self) -> list[str]:
        """Return what a user should know, in sentences."""
        words = [str(place + 1) for place in range(self.width) if place not in self.places]
        notes = [f"Left out, since they hold no numbers: columns {', '.join(words)}."] if words else []
        return [*notes, f"Empty fields, taken for unknown: {self.unknown:,}."] if self.unknown else notes


_QUOTED = re.compile(r'"([-+]?\d[\d.,]*(?:[eE][-+]?\d+)?)"')
_IN_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(?:,\d{3})+")


def without_commas(text: str) -> str:
    """Return a text whose numbers in quotes that hold commas, as in ``"500,1","540,3"``, have decimal points alone.

    Raises
    ------
    UnreadableInput
        If the commas may be decimal signs as well as what parts thousands.
    """
    quoted = [each for each in _QUOTED.findall(text) if "," in each] if '"' in text else []
    if not quoted:
        return text
    sign = _decimal_sign(quoted, text)
    other = "," if sign == "." else "."

    def plain(found: re.Match[str]) -> str:
        return found[1].replace(other, "").replace(sign, ".") if "," in found[1] else found[0]

    return _QUOTED.sub(plain, text)


def _decimal_sign(quoted: Sequence[str], text: str) -> str:
    """Return what parts the fractions of numbers that hold commas: the later of two signs, or as the text has it."""
    signs = {max(",.", key=each.rfind) for each in quoted if "." in each}
    if len(signs) == 1:
        return signs.pop()
    if not signs and not all(map(_IN_THOUSANDS.fullmatch, quoted)):
        return ","
    if not signs and (any(each.count(",") > 1 for each in quoted) or re.search(r"\d\.\d", text)):
        return "."
    if not signs and '","' not in text:
        return ","
    mend = "Write decimal points, and nothing between thousands."
    raise UnreadableInput("the commas within its numbers may be decimal signs or part thousands.", mend)


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
    try:
        rows = [(number, [each.strip(" \"'") for each in row]) for number, row in enumerate(read, first_line) if row]
    except csv.Error as error:
        raise UnreadableInput(f"it is no table ({error}).", "Each quote that begins a field must end it.") from error
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
