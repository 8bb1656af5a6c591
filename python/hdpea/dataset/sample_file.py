# SPDX-License-Identifier: GPL-3.0-or-later
"""A sample as one NPZ file; the same sample is the same bytes.

Arrays are not compressed: coordinates hardly shrink, and the output of a compressor depends on its version. Files
of every schema ever written stay readable, each by its function in ``_READERS``.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.lib.npyio import NpzFile
from numpy.typing import NDArray

from hdpea.dataset.sample import Sample
from hdpea.errors import UnreadableInput
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.reading import DAMAGE, read_bytes
from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.marking import save_arrays

SCHEMA = 1
SAMPLE_FORMATS = (".npz",)
_COLUMNS = {"points": 3, "normals": 3, "psi": 5, "curvatures": 2, "direction1": 3}
_OPTIONAL = ("surface_points", "estimated_normals", "sensors")


def write_sample(path: Path, sample: Sample) -> None:
    """Write a sample, replacing the file only once the new one is complete.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    check_output(path, SAMPLE_FORMATS)
    with replacing(path) as partial:
        partial.write_bytes(encoded(sample))


def encoded(sample: Sample) -> bytes:
    """Return the content of the file of a sample, without arrays that are None or equal to another."""
    arrays: dict[str, Any] = {name: getattr(sample, name) for name in (*_COLUMNS, *_OPTIONAL)}
    if np.array_equal(sample.surface_points, sample.points):
        arrays["surface_points"] = None
    stored: dict[str, Any] = {name: np.asarray(array, "<f4") for name, array in arrays.items() if array is not None}
    stored |= {"centre_in_world": np.asarray(sample.frame.centre_in_world, "<f8"), "diagonal": sample.frame.diagonal}
    stream = io.BytesIO()
    save_arrays(stream, "sample", schema=np.int64(SCHEMA), **stored)
    return stream.getvalue()


def read_sample(path: Path) -> Sample:
    """Read a sample of this or any older schema.

    Raises
    ------
    UnreadableInput
        If the file is missing, damaged, not a sample, or of a newer schema.
    """
    try:
        return decoded(read_bytes(path))
    except UnreadableInput as error:
        if str(path) in error.message:
            raise
        raise UnreadableInput(f"Cannot read {path}: {error.message}", error.hint) from error


def decoded(data: bytes) -> Sample:
    """Return the sample in a file of this content.

    Raises
    ------
    UnreadableInput
        If it is damaged, not a sample, or of a newer schema.
    """
    hint = "It may have been cut off while being copied."
    if not data.startswith(b"PK"):  # or NumPy takes it for a pickle
        raise UnreadableInput("it is not an NPZ file, or damaged.", hint)
    try:
        archive = np.load(io.BytesIO(data), allow_pickle=False)
        arrays = {name: archive[name] for name in archive.files} if isinstance(archive, NpzFile) else {}
    except DAMAGE as error:
        raise UnreadableInput(f"it is not an NPZ file, or damaged ({error}).", hint) from error
    schema = arrays.get("schema")
    if schema is None or schema.shape != () or schema.dtype.kind != "i":
        raise UnreadableInput("it is not a sample of a dataset.", "`hdpea dataset build` and `scan` write samples.")
    if int(schema) not in _READERS:
        raise UnreadableInput(f"it is a sample of schema {schema}, this hdpea reads up to {SCHEMA}.", "Update hdpea.")
    return _READERS[int(schema)](arrays)


def _read_1(arrays: Mapping[str, NDArray[Any]]) -> Sample:
    try:
        rows = {name: _rows(arrays[name], name, width) for name, width in _COLUMNS.items()}
        rows |= {name: _rows(arrays[name], name, 3) for name in _OPTIONAL if name in arrays}
        frame = UnitFrame(_finite(arrays["centre_in_world"], "centre_in_world", (3,)), float(arrays["diagonal"]))
    except (KeyError, TypeError) as error:
        raise UnreadableInput(
            f"it is a sample without {error}.", "It may have been written by another tool."
        ) from error
    if len({len(array) for array in rows.values()}) != 1:
        raise UnreadableInput("its arrays are of different lengths.", "It may have been written by another tool.")
    return Sample(**{"surface_points": rows["points"], **rows}, frame=frame)


def _rows(array: NDArray[Any], name: str, width: int) -> NDArray[np.float32]:
    if array.ndim != 2 or len(array) == 0:
        raise UnreadableInput(f"its array {name} has shape {array.shape}.", f"(n, {width}) with n > 0 is expected.")
    return _finite(array, name, (len(array), width)).astype(np.float32)


def _finite(array: NDArray[Any], name: str, shape: tuple[int, ...]) -> NDArray[Any]:
    if array.shape != shape or array.dtype.kind != "f" or not np.isfinite(array).all():
        raise UnreadableInput(f"its array {name} is not finite numbers of shape {shape}.", "Make the sample again.")
    return array


_READERS = {1: _read_1}
