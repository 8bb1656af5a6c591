# SPDX-License-Identifier: GPL-3.0-or-later
"""NPY and NPZ: arrays saved by numpy."""

from __future__ import annotations

import io
import math
import zipfile
from dataclasses import replace
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import PointCloud, from_columns
from hdpea.reading.tables import name_columns

MOST_COLUMNS = 64
"""More than any per-point table has: an array this wide has its points in columns."""

MOST_UNPACKED, ALWAYS_UNPACKED = 100, 1 << 28
"""How many times its size an archive may unpack to, and the bytes that any may."""

_POINT_KEYS = ("points", "xyz", "pos", "positions", "coord", "coords", "vertices", "arr_0")
_NORMAL_KEYS = ("normals", "normal")
_HINT = "Save an array of shape (n, 3), or an NPZ of `points` and, if known, `normals`."


def parse_npy(data: bytes) -> PointCloud:
    """Read an array (n, 3), (n, 6) with normals, wider, or structured with fields x, y, z.

    Raises
    ------
    UnreadableInput
        If the array is of another kind.
    """
    array = _load(data)
    if array.dtype.names is not None:
        return from_columns(_fields(array), "NPY, structured")
    return from_columns(name_columns(_as_rows(array, "the array")), f"NPY, {array.shape[1]} columns")


def _fields(array: NDArray[Any]) -> dict[str, NDArray[Any]]:
    return {name: array[name].ravel() for name in array.dtype.names or ()}


def parse_npz(data: bytes) -> PointCloud:
    """Read the arrays ``points`` (or ``xyz``), and ``normals`` if there; others of that length are attributes.

    Raises
    ------
    UnreadableInput
        If it holds no such points.
    """
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        members = {name.removesuffix(".npy"): name for name in archive.namelist() if name.endswith(".npy")}
        _require_sane_size(archive, len(data))
        key = next((key for key in _POINT_KEYS if key in members), None)
        if key is None:
            raise UnreadableInput(f"it has no array named points (found: {', '.join(members) or 'none'}).", _HINT)
        shapes = {name: _header(archive.open(member)) for name, member in members.items()}
        shape, dtype = shapes[key]
        if dtype.names is None:
            _require_rows(shape, dtype, key)
        arrays = {
            name: _load(archive.read(members[name]))
            for name, (other, kind) in shapes.items()
            if other[:1] == shape[:1] and not kind.hasobject
        }
    if key not in arrays:
        raise UnreadableInput(f"{key} is an array of {dtype}, which is not read.", _HINT)
    points = arrays.pop(key)
    columns = name_columns(_as_rows(points, key)) if dtype.names is None else _fields(points)
    cloud = from_columns(columns, f"NPZ, array {key!r}")
    normals = next((arrays.pop(name) for name in _NORMAL_KEYS if name in arrays), None)
    if normals is not None:
        normals = _as_rows(normals, "normals")[:, :3]
    unmatched = [name for name in _NORMAL_KEYS if name in shapes and shapes[name][0][:1] != shape[:1]]
    notes = tuple(f"Left out {name}: they are {shapes[name][0][:1]}, the points {shape[:1]}." for name in unmatched)
    return replace(
        cloud,
        normals=cloud.normals if normals is None else normals,
        attributes={**cloud.attributes, **arrays},
        notes=notes,
    )


def _require_sane_size(archive: zipfile.ZipFile, size: int) -> None:
    """Refuse an archive of `size` bytes that would unpack to far more than coordinates can be compressed from."""
    unpacked = sum(member.file_size for member in archive.infolist())
    if unpacked > max(MOST_UNPACKED * size, ALWAYS_UNPACKED):
        raise UnreadableInput(f"its {size:,} bytes would unpack to {unpacked:,}.", "Save the points alone.")


def _header(stream: IO[bytes]) -> tuple[tuple[int, ...], np.dtype[Any]]:
    """Return the shape and type that an array's header announces."""
    version = np.lib.format.read_magic(stream)
    read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    shape, _, dtype = read(stream)
    return shape, dtype


def _load(data: bytes) -> NDArray[Any]:
    """Return an array, of which no more memory is taken than it has data."""
    stream = io.BytesIO(data)
    shape, dtype = _header(stream)
    if math.prod(shape) * dtype.itemsize > len(data) - stream.tell():
        raise UnreadableInput(
            f"its header announces an array of shape {shape}, for which it is too short.",
            "It may have been cut off while being copied.",
        )
    return np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)


def _as_rows(array: NDArray[Any], name: str) -> NDArray[np.float64]:
    _require_rows(array.shape, array.dtype, name)
    return array.astype(np.float64)


def _require_rows(shape: tuple[int, ...], dtype: np.dtype[Any], name: str) -> None:
    if len(shape) != 2 or not 3 <= shape[1] <= MOST_COLUMNS or dtype.kind not in "fiu":
        raise UnreadableInput(f"{name} is {dtype} of shape {shape}, not numbers of shape (n, 3).", _HINT)
