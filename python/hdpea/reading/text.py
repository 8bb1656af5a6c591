# SPDX-License-Identifier: GPL-3.0-or-later
"""Text tables: XYZ, TXT, CSV, ASC, PTS, PWN, XYZN."""

from __future__ import annotations

import codecs
import csv
import re
from contextlib import suppress
from dataclasses import dataclass, field

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import PointCloud, from_columns
from hdpea.reading.columns import Columns, parse_columns, without_commas
from hdpea.reading.names import coordinates_among, plain_name
from hdpea.reading.tables import (
    BadLine,
    comma_is_decimal,
    count_of,
    is_number,
    name_columns,
    parse_table,
    without_words_for_nan,
)
from hdpea.reading.unnamed import require_points

_COMMENT = re.compile(r"(#|//|%)[^\n]*")
_UNREAD = re.compile(r"(?:\s+|(?:#|//|%)[^\n]*(?:\n|$))++")
"""Blank lines and comments; possessive, since there may be millions."""
_NAMES = re.compile(r"^(?:#|//|%)[^\n]*\bx\b[^\n]*", re.MULTILINE | re.IGNORECASE)
_COUNT = re.compile(r"^[ \t]*\d+[ \t\r]*$", re.MULTILINE)
UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
"""What a text in UTF-16 begins with, as PowerShell writes it."""
MOST_HEADER_LINES = 1_000
"""Lines before the first point, comments and blank ones aside, after which a text is no table."""
_FRACTION = re.compile(r",0\d")
"""Digits after a comma that begin with a zero, as no number does."""
_FORTRAN = re.compile(r"(\.\d*)[dD](?=[-+]\d{1,3}(?![^\s,;\"']))")
"""What Fortran writes before the exponent of a double: 1.0D+00."""
_SEPARATORS = str.maketrans(",;\t", "   ")
_PTS = {4: ["intensity"], 6: ["red", "green", "blue"], 7: ["intensity", "red", "green", "blue"]}
"""What follows x, y and z in a PTS file of so many columns."""


def decoded(data: bytes) -> str:
    """Return a text in UTF-16 where it says so, in UTF-8, or else as Windows writes it; question marks for the rest."""
    if data.startswith(UTF16):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def parse_text(data: bytes, normals_expected: bool = False) -> PointCloud:
    """Read a table of points, one a line, with or without a header, comments and counts of points.

    Separators are blanks, commas, semicolons and tabs; empty fields are unknown numbers, and columns of words are left
    out. Columns go by the header's names where it names x, y and z, else by ``name_columns``; a first column that
    numbers the rows, or is of times, is no coordinate then.

    Raises
    ------
    UnreadableInput
        If a line is not like the others, no column is x, y or z, the header does not fit the rows, what commas or the
        first columns are is not to be told, or they are heights.
    """
    text = without_commas(_with_exponents_of_c(without_words_for_nan(decoded(data))))
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    start = _find_numbers(text)
    body = text[start.offset :]
    announced = 0
    if start.counted is not None:
        announced = start.counted + sum(map(count_of, _COUNT.findall(body)))
        body = _COUNT.sub("", body)
    if _COMMENT.search(body):
        body = _COMMENT.sub("", body)
    if start.separator in {";", "\t"} or comma_is_decimal(start.line):
        body = body.replace(",", ".")
    elif start.separator == "," and "." not in body and _FRACTION.search(body):
        mend = "Write decimal points, or semicolons between the numbers."
        raise UnreadableInput("commas are its decimal signs, and between its numbers, too.", mend)
    try:
        columns = _columns(body, start)
    except BadLine as error:  # in which commas may have become points
        raise BadLine(error.number, text.splitlines()[error.number - 1], error.fault) from None
    if len(columns.table) < announced:
        cut = "It may have been cut off while being copied."
        raise UnreadableInput(f"it ends after {len(columns.table)} of its {announced} points.", cut)
    width = columns.width
    notes = columns.notes()
    if _names_fit(start, columns, notes):
        named = columns.named(_padded(start.header, width))
    else:
        columns = columns.without_row_numbers(notes, start.numbered)
        if not normals_expected and len(coordinates_among(map(plain_name, start.header))) < 3:
            require_points(columns.table)
            columns = columns.without_times(notes)
        named = name_columns(columns.table, normals_expected)
        if start.counted is not None and len(named) in _PTS and "nx" not in named:
            named = dict(zip(["x", "y", "z", *_PTS[len(named)]], named.values(), strict=True))
    return from_columns(named, f"text, {width} columns", notes)


def _with_exponents_of_c(text: str) -> str:
    return _FORTRAN.sub(r"\1e", text) if re.search("[dD][-+]", text) else text


def _names_fit(start: _Start, columns: Columns, notes: list[str]) -> bool:
    """Say whether the header names the columns; it must, if it names x, y and z elsewhere than in front."""
    plain = [plain_name(name) for name in start.header]
    if columns.fits(plain):
        return True
    named = coordinates_among(plain)
    if len(named) < 3:
        return False
    told = f"Its header names {len(plain)} columns, its rows have {columns.width}"
    if tuple(plain[:3]) != named:
        raise UnreadableInput(f"{told[0].lower()}{told[1:]}.", "Give each column a name.")
    notes.append(f"{told}: the first three are taken for coordinates.")
    return False


def _padded(header: list[str], width: int) -> list[str]:
    """Return the names of all columns: R does not name the one that numbers the rows."""
    names = ["", *header] if len(header) < width else header
    return [name or f"column_{i}" for i, name in enumerate(names, 1)]


def _columns(body: str, start: _Start) -> Columns:
    """Return the columns of the rows, quickly if all are numbers."""
    if not start.words:
        try:
            table = parse_table(body.replace('"', "").translate(_SEPARATORS).splitlines(), start.line_number)
        except UnreadableInput:
            if not start.separator:
                raise
        else:
            return Columns(table, list(range(table.shape[1])), table.shape[1])
    return parse_columns(body.splitlines(), start.separator, start.line_number)


@dataclass(frozen=True)
class _Start:
    """The first row and what is told before it.

    Attributes
    ----------
    offset, line_number, line, separator, words
        Where the first row begins, what it reads, what separates its fields, and whether some are no numbers.
    header
        The names of the columns.
    counted
        The number in a line of its own, which counts points.
    numbered
        Whether the header says, without naming columns, that the first numbers the rows.
    """

    offset: int
    line_number: int
    line: str
    separator: str
    words: bool
    header: list[str] = field(default_factory=list)
    counted: int | None = None
    numbered: bool = False


def _find_numbers(text: str) -> _Start:
    header: list[str] = []
    offset, counted, numbered = 0, None, False
    for _ in range(MOST_HEADER_LINES):
        unread = _UNREAD.match(text, offset)
        if unread is not None:
            header = next((names for line in _NAMES.findall(unread[0]) if (names := _named(line))), header)
            offset = unread.end()
        line = text[offset : text.find("\n", offset) + 1] or text[offset:]
        content = _COMMENT.sub("", line)
        if not content.strip():
            break
        separator = separator_of(content)
        tokens = fields_of(content, separator)
        numbers = [is_number(token) for token in tokens]
        after = text[offset + len(line) : offset + len(line) + 10_000].lstrip().split("\n")[0]
        following = fields_of(after, separator)
        if _counts_columns(tokens, following):
            header, numbered = [], tokens[0] == "" or len(following) > len(tokens)
        elif len(tokens) > 1 and (all(numbers) or _is_row(numbers, following)):
            line_number = text.count("\n", 0, offset) + 1
            return _Start(offset, line_number, content, separator, not all(numbers), header, counted, numbered)
        elif numbers == [True]:
            # The count of points that PTS files begin with.
            counted = count_of(tokens[0]) if tokens[0].isdecimal() else counted
        elif not _is_below_names(tokens, header):
            header = tokens
        offset += len(line)
    raise UnreadableInput("there are no points in it.", "One point a line is expected, as in: 0.1 0.2 0.3")


def _is_below_names(fields: list[str], header: list[str]) -> bool:
    """Say whether a line below a header that names x, y and z is of their units, or of dashes."""
    named, others = (len(coordinates_among(map(plain_name, each))) for each in (header, fields))
    is_shorter = len(fields) < len(header) and not any(map(str.isdecimal, "".join(fields)))
    return named == 3 and others < 3 and (len(fields) == len(header) or is_shorter)


def _counts_columns(fields: list[str], following: list[str]) -> bool:
    """Say whether a line is the header that pandas gives an array: 0, 1, 2 and so on, after nothing above an index.

    Where nothing says that there is an index, the next line must be of fractions: 0, 1, 2 may be a point.
    """
    names = fields[1:] if fields[0] == "" else fields
    if len(names) < 3 or names != [str(i) for i in range(len(names))]:
        return False
    alike = len(following) - len(names) in {0, 1}
    are_whole = (each.lstrip("-").isdecimal() for each in following[-len(names) :])
    return alike and (len(names) < len(fields) or not any(are_whole))


def _is_row(numbers: list[bool], following: list[str]) -> bool:
    """Say whether a line that is not all numbers is a row: it has three, and the next line has numbers there, too."""
    if sum(numbers) < 3:
        return False
    if following == [""]:
        return True
    alike = zip(numbers, following, strict=False)
    return len(following) == len(numbers) and all(not one or is_number(other) or not other for one, other in alike)


def separator_of(line: str) -> str:
    """Return what separates the fields of a line: a semicolon, a tab or a comma, or nothing but blanks ("")."""
    if comma_is_decimal(line) and ";" not in line and "\t" not in line:
        return ""
    return next((each for each in ";\t," if each in line.strip()), "")


def fields_of(line: str, separator: str) -> list[str]:
    """Return the fields of a line, without quotes; between separators other than blanks they may be empty."""
    fields = line.strip().split(separator) if separator else (line.split() or [""])
    if separator and '"' in line:
        with suppress(csv.Error):  # a field longer than any of a table
            fields = next(csv.reader([line.strip()], delimiter=separator))
    if separator not in {"", ","} or (not separator and comma_is_decimal(line)):
        fields = [each.replace(",", ".") for each in fields]
    return [each.strip().strip("\"'") for each in fields]


def _named(comment: str) -> list[str]:
    """Return the words of a comment if they name columns, else none."""
    line = comment.strip().lstrip("#/%")
    words = [each for each in re.split(r"[,;\s]+", line) if each]
    return words if "x" in map(str.lower, words) else []
