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
from hdpea.reading.tables import columns_by_name, parse_table

_FORMAT_NAMES = {"<": "binary little-endian PLY", ">": "binary big-endian PLY", "=": "text PLY"}
_ELEMENT = re.compile(rb"^element[ \t]+(\S+)[ \t]+(\d+)", re.MULTILINE)
_END_OF_HEADER = re.compile(rb"^end_header[ \t]*(\r\n|\n|\r)", re.MULTILINE)


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
    head = data[:body_start]
    # The library reads the header only: over a body of text, or over a stream, it walks value by value.
    header = PlyData.read(io.BytesIO(_ELEMENT.sub(rb"element \1 0", head)))
    counts = {name.decode(): int(count) for name, count in _ELEMENT.findall(head)}
    if not counts.get("vertex"):
        raise UnreadableInput("there are no points in it.", "PLY points are elements named 'vertex'.")
    if _is_plain(header):
        columns = _read_plain(header, data, body_start, counts["vertex"])
    else:
        _require_room(header, counts, len(data) - body_start)
        columns = _read_any(data)
    return from_columns(columns, _FORMAT_NAMES[header.byte_order], [MESH_NOTE] if counts.get("face") else [])


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


def _read_plain(header: PlyData, data: bytes, body_start: int, count: int) -> Mapping[str, NDArray[Any]]:
    vertex = header["vertex"]
    if header.text:
        lines = data[body_start:].decode().splitlines()[:count]
        table = parse_table(lines, data[:body_start].count(b"\n") + 1, len(vertex.properties))
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


def _read_any(data: bytes) -> dict[str, NDArray[Any]]:
    with warnings.catch_warnings():
        # The library stumbles over lists of length 0, without harm.
        warnings.simplefilter("ignore")
        return _by_name(PlyData.read(io.BytesIO(data))["vertex"].data)


def _by_name(table: NDArray[np.void]) -> dict[str, NDArray[Any]]:
    return {name: table[name] for name in table.dtype.names or () if table.dtype[name].kind != "O"}
