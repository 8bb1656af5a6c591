# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors to files: PLY and CSV (a column for each number), NPZ and VTP (an array for each quantity)."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.curvature.tensors import CurvatureTensors
from hdpea.errors import UsageError
from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.marking import marked, save_arrays
from hdpea.writing.points import point_ply

UPPER = np.triu_indices(3)
"""Of a metric tensor, which is symmetric: xx, xy, xz, yy, yz, zz."""


def columns_of(tensors: CurvatureTensors) -> dict[str, NDArray[Any]]:
    """Return every number of each point but its position and normal, as columns (n,) by name."""
    columns: dict[str, NDArray[Any]] = {
        f"direction{which}_{axis}": column
        for which, direction in ((1, tensors.direction1), (2, tensors.direction2))
        for axis, column in zip("xyz", direction.T, strict=True)
    }
    for name, pair in (("curvature", tensors.curvatures), ("stretch", tensors.stretches)):
        columns |= {f"{name}{which}": pair[:, which - 1] for which in (1, 2)}
    columns["stretching_ratio"] = tensors.stretching_ratio
    columns |= {f"metric_{'xyz'[i]}{'xyz'[j]}": tensors.metric[:, i, j] for i, j in zip(*UPPER, strict=True)}
    return columns | {"determined": tensors.determined.astype(np.float64), "point_index": tensors.point_index}


def arrays_of(tensors: CurvatureTensors) -> dict[str, NDArray[np.generic]]:
    """Return every quantity of each point but its position, as arrays (n, ...) by name."""
    return {
        "normals": tensors.normals,
        "direction1": tensors.direction1,
        "direction2": tensors.direction2,
        "curvatures": tensors.curvatures,
        "stretches": tensors.stretches,
        "stretching_ratio": tensors.stretching_ratio,
        "metric": tensors.metric,
        "determined": tensors.determined,
        "point_index": tensors.point_index,
    }


def check_curvature_output(path: Path) -> None:
    """Make sure that `path` can be written, as far as can be known beforehand.

    Raises
    ------
    UsageError
        If it cannot, or is a VTP file and pyvista is missing.
    """
    check_output(path, CURVATURE_FORMATS)
    if path.suffix.lower() == ".vtp" and find_spec("pyvista") is None:
        raise UsageError("Cannot write VTP: pyvista is not installed.", "pip install 'hdpea[picture]'")


def write_curvature(path: Path, tensors: CurvatureTensors) -> None:
    """Write curvature tensors as PLY, NPZ, CSV or VTP, by the extension of `path`.

    Parameters
    ----------
    path
        Replaced only once the new file is complete.

    Raises
    ------
    UsageError
        If the file cannot be written, or is a VTP file and pyvista is missing.
    """
    check_curvature_output(path)
    with replacing(path) as partial:
        CURVATURE_FORMATS[path.suffix.lower()](partial, tensors)


def _write_ply(path: Path, tensors: CurvatureTensors) -> None:
    path.write_bytes(point_ply(tensors.points, tensors.normals, columns_of(tensors), "curvature"))


def _write_npz(path: Path, tensors: CurvatureTensors) -> None:
    save_arrays(path, "curvature", points=tensors.points, **arrays_of(tensors))


def _write_csv(path: Path, tensors: CurvatureTensors) -> None:
    columns = columns_of(tensors)
    names = ["x", "y", "z", "nx", "ny", "nz", *columns]
    numbers = [each.tolist() for each in (*tensors.points.T, *tensors.normals.T, *columns.values())]
    with path.open("w") as file:
        file.write(",".join(names) + "\n")
        # repr is the shortest text that reads back as the same number.
        file.writelines(",".join(map(repr, row)) + "\n" for row in zip(*numbers, strict=True))


def _write_vtp(path: Path, tensors: CurvatureTensors) -> None:
    import pyvista

    cloud = pyvista.PolyData(tensors.points)
    for name, array in arrays_of(tensors).items():
        cloud.point_data[name] = array.reshape(len(array), -1) if array.ndim > 2 else array
    cloud.save(path)
    path.write_bytes(marked(path.read_bytes(), ".vtp", "curvature"))


CURVATURE_FORMATS: dict[str, Callable[[Path, CurvatureTensors], None]] = {
    ".ply": _write_ply,
    ".npz": _write_npz,
    ".csv": _write_csv,
    ".vtp": _write_vtp,
}
