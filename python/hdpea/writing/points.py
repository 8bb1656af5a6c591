# SPDX-License-Identifier: GPL-3.0-or-later
"""Points to files: embedded ones, those of scans, and those that were left out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.attributes import columns_of
from hdpea.writing.marking import marked, save_arrays
from hdpea.writing.ply import ply

Points = NDArray[np.float64]

POINT_FORMATS = (".npz", ".ply")

REASONS = "reason 1: lies on no surface; 2: crowds on scan lines"


def write_dropped(path: Path, points: NDArray[np.float64], reasons: NDArray[np.uint8]) -> None:
    """Write points (m, 3) with the reasons (m,) why they were left out, as PLY or NPZ (arrays points and reason).

    Parameters
    ----------
    path
        Replaced only once the new file is complete.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    check_output(path, POINT_FORMATS)
    with replacing(path) as partial:
        if path.suffix.lower() == ".npz":
            save_arrays(partial, "set of dropped points", points=points, reason=reasons)
            return
        partial.write_bytes(point_ply(points, None, {"reason": reasons}, "set of dropped points", [REASONS]))


def write_points(
    path: Path, points: Points, normals: Points, coordinates: Points, point_index: NDArray[np.int64]
) -> None:
    """Write embedded points as NPZ (arrays of these names) or PLY (embedding_0 to embedding_7, point_index).

    Parameters
    ----------
    path
        Replaced only once the new file is complete.
    points, normals
        (n, 3) float64.
    coordinates
        (n, 8) float64, the embedding.
    point_index
        (n,) int64, which of the points of the input they are.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    check_output(path, POINT_FORMATS)
    with replacing(path) as partial:
        if path.suffix.lower() == ".npz":
            arrays = {"points": points, "normals": normals, "coordinates": coordinates, "point_index": point_index}
            save_arrays(partial, "embedding", **arrays)
        else:
            others = {"embedding": coordinates, "point_index": point_index}
            partial.write_bytes(point_ply(points, normals, others, "embedding"))


def point_ply(
    points: Points,
    normals: Points | None,
    others: Mapping[str, NDArray[Any]],
    kind: str = "scan",
    comments: Sequence[str] = (),
) -> bytes:
    """Return the content of a PLY file of points (n, 3), their normals (n, 3) if any, and others, (n,) or (n, c).

    Points and normals are written as doubles, others as the attributes of meshes. It is marked as `kind`.
    """
    columns: dict[str, NDArray[Any]] = dict(zip("xyz", points.T, strict=True))
    if normals is not None:
        columns |= zip(("nx", "ny", "nz"), normals.T, strict=True)
    columns |= columns_of(others, len(points))
    table = np.empty(len(points), [(name, column.dtype.newbyteorder("<")) for name, column in columns.items()])
    for name, column in columns.items():
        table[name] = column
    return marked(ply(table, comments=comments), ".ply", kind)
