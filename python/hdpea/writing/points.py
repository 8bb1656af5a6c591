# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that were left out, to files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from plyfile import PlyData, PlyElement

from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.marking import save_arrays
from hdpea.writing.meshes import POINT_FORMATS

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
        table = np.empty(len(points), [("x", "<f8"), ("y", "<f8"), ("z", "<f8"), ("reason", "u1")])
        table["x"], table["y"], table["z"] = points.T
        table["reason"] = reasons
        comments = [mark_of("set of dropped points"), REASONS]
        PlyData([PlyElement.describe(table, "vertex")], byte_order="<", comments=comments).write(str(partial))
