# SPDX-License-Identifier: GPL-3.0-or-later
"""LAS, LAZ and COPC, by laspy."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.arrays import ALWAYS_UNPACKED, MOST_UNPACKED
from hdpea.reading.cloud import PointCloud, from_columns
from hdpea.reading.names import NORMAL_NAMES, plain_name

CHUNK = 1_000_000
"""Points decoded at a time: the file and its points are in memory, nothing else of their size."""

FIRST = 100_000
"""Points that are looked at for colours in a file that is not read whole."""

PROJECTED, GEOGRAPHIC = 3072, 2048
"""Keys of GeoTIFF whose values are the EPSG codes of coordinate reference systems."""

USER_DEFINED = 32767
"""The value of such a key that is no code."""

VLRS, VLR_HEADER, EVLR_HEADER = struct.Struct("<100xI"), 54, 60
"""Where a file says how many variable length records it has; bytes of each, and of each extended one, at least."""

CHUNK_TABLE, CHUNKS = struct.Struct("<q"), struct.Struct("<4xI")
"""Before the points, where the table of chunks is; in that, how many there are, of which each takes bytes."""

COLORS = (("red", "green", "blue"), ("nir",))
"""Dimensions that a format with colours has, whether anybody filled them in or not."""

_GRID = frozenset("XYZ")


def parse_las(data: bytes) -> PointCloud:
    """Read the points of a LAS, LAZ or COPC file at its scale and offset, with all their dimensions and their CRS.

    Points that are marked as withheld, which the format takes for deleted, are left out. A dimension that is zero
    everywhere stays, so that the files of a delivery, which have one format, have the same attributes. Colours that are
    black everywhere do not: nobody filled them in, and they would paint the mesh black.

    Raises
    ------
    laspy.errors.LaspyException
        If it is damaged.
    """
    import laspy

    (vlrs,) = VLRS.unpack_from(data)
    _require_room(vlrs * VLR_HEADER, len(data))
    with laspy.open(io.BytesIO(data), read_evlrs=False) as reader:
        header = reader.header
        _require_room(header.number_of_evlrs * EVLR_HEADER, len(data))
        reader.read_evlrs()
        if header.are_points_compressed:
            _require_room(_chunks(data, header.offset_to_point_data), len(data))
        if header.point_count == 0:
            raise UnreadableInput("there are no points in it.")
        _require_room(header.point_count * header.point_format.size, max(MOST_UNPACKED * len(data), ALWAYS_UNPACKED))
        names = [name for name in header.point_format.dimension_names if name not in _GRID]
        columns: dict[str, NDArray[Any]] = {}
        start = 0
        for chunk in reader.chunk_iterator(CHUNK):
            for name in ("x", "y", "z", *names):
                values = np.asarray(chunk[name])
                if name not in columns:
                    columns[name] = np.zeros((header.point_count, *values.shape[1:]), values.dtype)
                columns[name][start : start + len(chunk)] = values
            start += len(chunk)
        if start < header.point_count:
            raise ValueError(f"it ends after {start} of its {header.point_count} points")
        told = [*header.vlrs, *(header.evlrs or [])]
    kept = ~columns.pop("withheld").astype(bool) if "withheld" in columns else np.ones(start, bool)
    columns = _filled_in(columns)
    withheld = start - int(kept.sum())
    notes = [f"Left out points that are withheld: {withheld:,}."] if withheld else []
    kind = f"{'LAZ' if header.are_points_compressed else 'LAS'} {header.version}"
    cloud = from_columns({name: values[kept] for name, values in columns.items()}, kind, notes)
    return replace(cloud, crs=crs_of(told), point_index=np.flatnonzero(kept) if withheld else None)


def _filled_in(columns: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
    """Return the dimensions without colours that are black everywhere."""
    black = {
        name for group in COLORS if not any(columns[each].any() for each in group if each in columns) for name in group
    }
    return {name: values for name, values in columns.items() if name not in black}


def attributes_of_las(reader: Any) -> tuple[str, ...]:
    """Return the names of the attributes that ``parse_las`` gives the points of a file that laspy has opened.

    Whether there are colours is told by its first points.
    """
    first = reader.read_points(FIRST)
    names = [name for name in first.point_format.dimension_names if name not in {*_GRID, "withheld"}]
    return tuple(
        from_columns(_filled_in({name: np.asarray(first[name]) for name in ("x", "y", "z", *names)}), "LAS").attributes
    )


def parse_las_chunk(chunk: Any) -> PointCloud:
    """Return the points of a chunk, as laspy reads it, with normals and classes, without those that are withheld."""
    names = [name for name in chunk.point_format.dimension_names if name not in _GRID]
    kept = ~np.asarray(chunk["withheld"]).astype(bool) if "withheld" in names else np.ones(len(chunk), bool)
    normals = [name for name in names if any(plain_name(name) in each for each in NORMAL_NAMES)]
    classes = [name for name in names if name == "classification"]
    return from_columns({name: np.asarray(chunk[name])[kept] for name in ("x", "y", "z", *normals, *classes)}, "LAS")


def _chunks(data: bytes, start: int) -> int:
    """Return how many chunks a LAZ file says to have: its library ends the process if it has no memory for so many."""
    (table,) = CHUNK_TABLE.unpack_from(data, start)
    if table == -1:  # of a file that was written in one go
        (table,) = CHUNK_TABLE.unpack_from(data, len(data) - CHUNK_TABLE.size)
    if not 0 <= table <= len(data) - CHUNKS.size:
        raise ValueError("its table of chunks is not there")
    return int(CHUNKS.unpack_from(data, table)[0])


def _require_room(announced: int, most: int) -> None:
    """Refuse a header that promises more bytes than the file can hold, before time and memory are taken for them."""
    if announced > most:
        raise UnreadableInput(
            f"it cannot hold the {announced:,} bytes that its header announces.",
            "It may have been cut off while being copied.",
        )


def crs_of(vlrs: Iterable[Any]) -> str | None:
    """Return the coordinate reference system as WKT, or as an EPSG code."""
    keys: dict[int, int] = {}
    for vlr in vlrs:
        wkt = getattr(vlr, "string", "") if type(vlr).__name__ == "WktCoordinateSystemVlr" else ""
        if wkt.strip("\0 "):
            return str(wkt.strip("\0 "))
        keys |= {key.id: key.value_offset for key in getattr(vlr, "geo_keys", ())}
    codes = (keys.get(key, USER_DEFINED) for key in (PROJECTED, GEOGRAPHIC))
    return next((f"EPSG:{code}" for code in codes if code not in {0, USER_DEFINED}), None)
