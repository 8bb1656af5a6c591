# SPDX-License-Identifier: GPL-3.0-or-later
"""NPY and NPZ: arrays saved by numpy."""

from __future__ import annotations

import io
import zipfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import PointCloud, from_columns
from hdpea.reading.tables import name_columns

MOST_COLUMNS = 64
"""More than any per-point table has: an array this wide has its points in columns."""
_POINT_KEYS = ("points", "xyz", "pos", "vertices", "arr_0")
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
        return from_columns({name: array[name] for name in array.dtype.names}, "NPY, structured")
    return from_columns(name_columns(_as_rows(array, "the array")), f"NPY, {array.shape[1]} columns")


def parse_npz(data: bytes) -> PointCloud:
    """Read the arrays ``points`` (or ``xyz``), and ``normals`` if there; others of that length are attributes.

    Raises
    ------
    UnreadableInput
        If it holds no such points.
    """
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        arrays = {name.removesuffix(".npy"): _load(archive.read(name)) for name in archive.namelist()}
    key = next((key for key in _POINT_KEYS if key in arrays), None)
    if key is None:
        raise UnreadableInput(f"it has no array named points (found: {', '.join(arrays)}).", _HINT)
    cloud = from_columns(name_columns(_as_rows(arrays.pop(key), key)), f"NPZ, array {key!r}")
    per_point = {name: array for name, array in arrays.items() if array.shape[:1] == cloud.points.shape[:1]}
    normals = per_point.pop("normals", None)
    if normals is not None:
        normals = _as_rows(normals, "normals")[:, :3]
    return PointCloud(
        cloud.points, cloud.normals if normals is None else normals, {**cloud.attributes, **per_point}, cloud.format
    )


def _load(data: bytes) -> NDArray[Any]:
    return np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)


def _as_rows(array: NDArray[Any], name: str) -> NDArray[np.float64]:
    if array.ndim != 2 or not 3 <= array.shape[1] <= MOST_COLUMNS or array.dtype.kind not in "fiu":
        raise UnreadableInput(f"{name} is {array.dtype} of shape {array.shape}, not numbers of shape (n, 3).", _HINT)
    return array.astype(np.float64)
