# SPDX-License-Identifier: GPL-3.0-or-later
"""Points that were left out, to files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.marking import save_arrays
from hdpea.writing.meshes import POINT_FORMATS, point_ply

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
