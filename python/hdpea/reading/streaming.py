# SPDX-License-Identifier: GPL-3.0-or-later
"""Point clouds piece by piece, for those that are larger than memory."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from plyfile import PlyData, PlyListProperty

from hdpea.reading.cloud import PointCloud, from_columns
from hdpea.reading.las import attributes_of_las, crs_of, parse_las_chunk

CHUNK = 1_000_000
"""Points in memory at a time."""

HEADER_BYTES = 1 << 16
"""Longest header of a PLY file that is looked at."""


@dataclass(frozen=True)
class PointStream:
    """A cloud that can be gone through, piece by piece, as often as wanted.

    Attributes
    ----------
    name, format, crs
        As of a ``PointCloud``.
    count
        Points that its header announces.
    chunks
        Returns the pieces, in the order of the file: points, normals and sensors, as they are in it.
    identity
        What tells it from any other cloud: of a file its name, size and time, of arrays a digest.
    streamed
        Whether only a piece of it is in memory at a time.
    attributes
        Returns the names of what its points have, where the pieces leave some of them out; none where they do not.
    normals
        Whether its header tells of normals.
    """

    name: str
    format: str
    count: int
    chunks: Callable[[], Iterator[PointCloud]]
    crs: str | None = None
    identity: str = ""
    streamed: bool = True
    attributes: Callable[[], tuple[str, ...]] = tuple
    normals: bool = False


def stream_of(path: Path) -> PointStream | None:
    """Return a stream of a LAS, LAZ, COPC or binary PLY file; None of any other.

    Raises
    ------
    UnreadableInput
        While it is gone through, if it has no coordinates.
    """
    try:
        with path.open("rb") as file:
            head = file.read(HEADER_BYTES)
    except OSError:
        return None  # the usual reader says what is wrong
    if head.startswith(b"LASF"):
        return _las_stream(path)
    return _ply_stream(path, head) if head.startswith(b"ply") else None


def stream_of_cloud(cloud: PointCloud, name: str) -> PointStream:
    """Return a stream of a cloud that is in memory."""

    def chunks() -> Iterator[PointCloud]:
        for start in range(0, len(cloud.points), CHUNK):
            rows = slice(start, start + CHUNK)
            yield cloud.at(np.arange(*rows.indices(len(cloud.points))))

    return PointStream(name, cloud.format, len(cloud.points), chunks, cloud.crs, _digest(cloud), streamed=False)


def _las_stream(path: Path) -> PointStream | None:
    try:
        import laspy
    except ImportError:
        return None
    try:
        with laspy.open(path) as reader:
            header = reader.header
            told = [*header.vlrs, *(header.evlrs or [])]
    except Exception:  # noqa: BLE001 the usual reader says what is wrong
        return None

    def chunks() -> Iterator[PointCloud]:
        with laspy.open(path) as reader:
            for chunk in reader.chunk_iterator(CHUNK):
                yield parse_las_chunk(chunk)

    def attributes() -> tuple[str, ...]:
        with laspy.open(path) as reader:
            return attributes_of_las(reader)

    kind = "LAZ" if header.are_points_compressed else "LAS"
    name, count = f"{kind} {header.version}", header.point_count
    return PointStream(str(path), name, count, chunks, crs_of(told), _identity(path), attributes=attributes)


def _ply_stream(path: Path, head: bytes) -> PointStream | None:
    """Map the vertices of a binary PLY file, if they come first and each takes the same room."""
    end = head.find(b"end_header")
    start = head.find(b"\n", end) + 1
    if end < 0 or start == 0:
        return None
    try:
        header = PlyData.read(io.BytesIO(_without_rows(head[:start])))
    except Exception:  # noqa: BLE001 the usual reader says what is wrong, or knows the dialect
        return None
    count = _rows_of(head[:start])
    vertex = header.elements[0]
    if header.text or vertex.name != "vertex" or any(isinstance(each, PlyListProperty) for each in vertex.properties):
        return None
    rows = np.dtype(vertex.dtype(header.byte_order))
    if path.stat().st_size < start + count * rows.itemsize:
        return None

    def chunks() -> Iterator[PointCloud]:
        table = np.memmap(path, rows, "r", start, (count,))
        for first in range(0, count, CHUNK):
            piece = np.array(table[first : first + CHUNK])
            yield from_columns({name: piece[name] for name in rows.names or ()}, "PLY")

    order = "little" if header.byte_order == "<" else "big"
    normals = {"nx", "ny", "nz"} <= set(rows.names or ())
    name = f"binary {order}-endian PLY"
    return PointStream(str(path), name, count, chunks, identity=_identity(path), normals=normals)


def _identity(path: Path) -> str:
    status = path.stat()
    return f"{path.resolve()} {status.st_size} {status.st_mtime_ns}"


def _digest(cloud: PointCloud) -> str:
    digest = hashlib.sha256()
    for array in (cloud.points, cloud.normals, cloud.sensors()):
        digest.update(b"" if array is None else np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


def _without_rows(head: bytes) -> bytes:
    """Return the header with 0 rows of every element, so that the library reads no row."""
    lines = head.split(b"\n")
    return b"\n".join(b" ".join([*line.split()[:2], b"0"]) if line.startswith(b"element ") else line for line in lines)


def _rows_of(head: bytes) -> int:
    """Return how many rows the first element has."""
    return next(int(line.split()[2]) for line in head.split(b"\n") if line.startswith(b"element "))
