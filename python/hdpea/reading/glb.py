# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the vertices of a GLB file lie, if hdpea wrote it."""

from __future__ import annotations

import json
import struct

import numpy as np
from numpy.typing import NDArray


def placed_in_world(data: bytes, vertices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the vertices (v, 3) of a GLB file with z up and where they lay before they were shifted.

    Only a file that says its shift is one of ours; the axes of others are as they are.
    """
    (length,) = struct.unpack_from("<I", data, 12)
    nodes = json.loads(data[20 : 20 + length]).get("nodes", [])
    extras = nodes[0].get("extras") if len(nodes) == 1 else None
    if not isinstance(extras, dict) or extras.get("up") != "y" or "shift" not in extras:
        return vertices
    x, y, z = vertices.T
    return np.stack([x, -z, y], axis=1) + np.asarray(extras["shift"], np.float64)
