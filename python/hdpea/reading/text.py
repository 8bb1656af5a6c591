# SPDX-License-Identifier: GPL-3.0-or-later
"""Text tables: XYZ, TXT, CSV, ASC, PTS, PWN, XYZN."""

from __future__ import annotations

import re
from dataclasses import dataclass

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import PointCloud, from_columns
from hdpea.reading.tables import columns_by_name, comma_is_decimal, is_number, name_columns, parse_table

_COMMENT = re.compile(r"(#|//|%)[^\n]*")
_UNREAD = re.compile(r"(?:\s+|(?:#|//|%)[^\n]*(?:\n|$))++")
"""Blank lines and comments; possessive, since there may be millions."""
_NAMES = re.compile(r"^(?:#|//|%)[^\n]*\bx\b[^\n]*", re.MULTILINE | re.IGNORECASE)
MOST_HEADER_LINES = 1_000
"""Lines before the first point, comments and blank ones aside, after which a text is no table."""
_SEPARATORS = str.maketrans(",;\t", "   ")


def parse_text(data: bytes, normals_expected: bool = False) -> PointCloud:
    """Read a table of points, one a line, with or without a header, comments and a leading count.

    Separators are blanks, commas, semicolons and tabs. Columns go by the header's names where it
    names them all, else by ``name_columns``.

    Raises
    ------
    UnreadableInput
        If a line is not as many numbers as the others, or no column is x, y or z.
    """
    text = data.decode("utf-8-sig", errors="replace")
    start = _find_numbers(text)
    body = text[start.offset :]
    if _COMMENT.search(body):
        body = _COMMENT.sub("", body)
    if comma_is_decimal(start.line):
        body = body.replace(",", ".")
    table = parse_table(body.translate(_SEPARATORS).splitlines(), start.line_number)
    width = table.shape[1]
    named = len(start.header) == width
    columns = columns_by_name(start.header, table) if named else name_columns(table, normals_expected)
    return from_columns(columns, f"text, {width} columns")


@dataclass(frozen=True)
class _Start:
    """The first line of numbers, and the words of the header before it."""

    offset: int
    line_number: int
    line: str
    header: list[str]


def _find_numbers(text: str) -> _Start:
    header: list[str] = []
    offset = 0
    for _ in range(MOST_HEADER_LINES):
        unread = _UNREAD.match(text, offset)
        if unread is not None:
            header = next((names for line in _NAMES.findall(unread[0]) if (names := _named(line))), header)
            offset = unread.end()
        line = text[offset : text.find("\n", offset) + 1] or text[offset:]
        content = _COMMENT.sub("", line)
        tokens = _tokens(content)
        if not tokens:
            break
        if not all(map(is_number, tokens)):
            header = tokens
        elif len(tokens) > 1:
            return _Start(offset, text.count("\n", 0, offset) + 1, content, header)
        # What is left is a single number: the count of points that PTS files begin with.
        offset += len(line)
    raise UnreadableInput("there are no points in it.", "One point a line is expected, as in: 0.1 0.2 0.3")


def _named(comment: str) -> list[str]:
    """Return the words of a comment if they name columns, else none."""
    words = _tokens(comment.strip().lstrip("#/%"))
    return words if "x" in map(str.lower, words) else []


def _tokens(line: str) -> list[str]:
    return [token.strip("\"'") for token in re.split(r"[,;\s]+", line.strip()) if token]
