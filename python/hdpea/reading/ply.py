# SPDX-License-Identifier: GPL-3.0-or-later
"""PLY, text and binary, with any properties."""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from plyfile import PlyData, PlyListProperty, PlyProperty

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import MESH_NOTE, PointCloud, from_columns
from hdpea.reading.ply_dialects import meaning_of
from hdpea.reading.tables import columns_by_name, parse_table, without_words_for_nan

_FORMAT_NAMES = {"<": "binary little-endian PLY", ">": "binary big-endian PLY", "=": "text PLY"}
_ELEMENT = re.compile(rb"^element[ \t]+(\S+)[ \t]+(\d+)", re.MULTILINE)
_COMMENT = re.compile(rb"^(?:comment|obj_info)\b[^\r\n]*(?:\r\n|\n|\r)", re.MULTILINE)
_POINTS = re.compile(rb"^(element[ \t]+)(?:vertices|points?)(?=[ \t])", re.MULTILINE | re.IGNORECASE)
_NAME = re.compile(rb"^(property[ \t]+(?:list[ \t]+\S+[ \t]+)?\S+[ \t]+)(\S[^\r\n]*)", re.MULTILINE)
_BEFORE_END = re.compile(rb"(?=^element[ \t])", re.MULTILINE)
_END_OF_HEADER = re.compile(rb"(?<=\n)end_header[ \t]*(?:\r\n|\n|\r)|(?<=\r)end_header[ \t]*\r")
"""Where lines end in a carriage return alone, a line feed after it is of the first point."""
_END_OF_LINE = re.compile(rb"[ \t]*(?:\r\n|\n|\r)")


def parse_ply(data: bytes) -> PointCloud:
    """Read the vertices of a PLY file with all their scalar properties.

    Raises
    ------
    UnreadableInput
        If the file ends early, or has no vertices with x, y and z.
    plyfile.PlyParseError
        If its header is damaged.
    """
    end = _END_OF_HEADER.search(data)
    body_start = end.end() if end else len(data)
    first_line = data.count(b"\n", 0, body_start) + 1
    head = _plain_header(data[:body_start])
    # The library reads the header only: over a body of text, or over a stream, it walks value by value.
    header = PlyData.read(io.BytesIO(_ELEMENT.sub(rb"element \1 0", head)))
    counts = {name.decode(): int(count) for name, count in _ELEMENT.findall(head)}
    if not counts.get("vertex"):
        raise UnreadableInput("there are no points in it.", "PLY points are elements named 'vertex'.")
    if _is_plain(header):
        columns = _read_plain(header, data, body_start, counts["vertex"], first_line)
        elements: Mapping[str, Mapping[str, NDArray[Any]]] = {"vertex": columns}
    else:
        _require_room(header, counts, len(data) - body_start)
        body = data[body_start:]
        if header.text:
            body = without_words_for_nan(body.decode("latin1")).encode("latin1")
        elements = _read_any(head + body)
    notes = [MESH_NOTE] if counts.get("face") else []
    return from_columns(meaning_of(elements, notes), _FORMAT_NAMES[header.byte_order], notes)


def _plain_header(head: bytes) -> bytes:
    """Return a header of nothing but ASCII, without comments, with names that occur once in each element.

    Its lines end as those of Unix do, without blanks before.
    """
    plain = _POINTS.sub(rb"\1vertex", _COMMENT.sub(b"", _END_OF_LINE.sub(b"\n", head)))
    elements = []
    for element in _BEFORE_END.split(plain):
        taken: set[bytes] = set()

        def unique(found: re.Match[bytes], taken: set[bytes] = taken) -> bytes:
            name = re.sub(rb"[^!-~]", b"_", found[2].rstrip())
            while name in taken:
                name += b"_"
            taken.add(name)
            return found[1] + name

        elements.append(_NAME.sub(unique, element))
    return re.sub(rb"[\x80-\xff]", b"_", b"".join(elements))


def _require_room(header: PlyData, counts: Mapping[str, int], room: int) -> None:
    """Refuse a header that promises more than a body of `room` bytes can hold, before memory is taken for it."""
    for element in header.elements:
        least = max(sum(_least_bytes(each, header.text) for each in element.properties), 1)
        if counts.get(element.name, 0) * least > room + header.text:
            raise UnreadableInput(
                f"it cannot hold the {counts[element.name]:,} rows of {element.name!r} that its header announces.",
                "It may have been cut off while being copied.",
            )


def _least_bytes(each: PlyProperty, text: bool) -> int:
    """Return the fewest bytes that a property takes: as text a digit and what ends it, a list by its length alone."""
    if text:
        return 2
    return int(np.dtype(each.len_dtype if isinstance(each, PlyListProperty) else each.dtype()).itemsize)


def _is_plain(header: PlyData) -> bool:
    """Say whether the vertices come first and each takes the same room."""
    return header.elements[0].name == "vertex" and not any(
        isinstance(each, PlyListProperty) for each in header["vertex"].properties
    )


def _read_plain(
    header: PlyData, data: bytes, body_start: int, count: int, first_line: int
) -> Mapping[str, NDArray[Any]]:
    vertex = header["vertex"]
    if header.text:
        lines = data[body_start:].decode(errors="replace").splitlines()
        table = parse_table(_rows_of(lines, count), first_line, len(vertex.properties))
        # Doubles, even where the header says float: the text may hold more digits than that.
        columns: Mapping[str, NDArray[Any]] = columns_by_name([each.name for each in vertex.properties], table)
        found = len(table)
    else:
        dtype = np.dtype(vertex.dtype(header.byte_order))
        found = min(count, (len(data) - body_start) // dtype.itemsize)
        columns = _by_name(np.frombuffer(data, dtype, found, body_start))
    if found < count:
        raise UnreadableInput(
            f"it ends after {found} of its {count} points.", "It may have been cut off while being copied."
        )
    return columns


def _rows_of(lines: list[str], count: int) -> list[str]:
    """Return the lines up to the `count`-th that is not blank."""
    if all(map(str.strip, lines[:count])):
        return lines[:count]
    filled = [i for i, line in enumerate(lines) if line.strip()]
    return lines[: filled[count - 1] + 1] if len(filled) >= count else lines


def _read_any(data: bytes) -> dict[str, dict[str, NDArray[Any]]]:
    with warnings.catch_warnings():
        # The library stumbles over lists of length 0, without harm.
        warnings.simplefilter("ignore")
        return {each.name: _by_name(each.data) for each in PlyData.read(io.BytesIO(data)).elements}


def _by_name(table: NDArray[np.void]) -> dict[str, NDArray[Any]]:
    return {name: table[name] for name in table.dtype.names or () if table.dtype[name].kind != "O"}
