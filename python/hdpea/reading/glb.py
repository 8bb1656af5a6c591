# SPDX-License-Identifier: GPL-3.0-or-later
"""What was written into a GLB file, if hdpea wrote it."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.color import srgb_of_linear
from hdpea.geometry.triangles import TriangleMesh

AHEAD = {"z": ([0, 2, 1], [1, -1, 1]), "y": ([0, 1, 2], [1, 1, 1]), "-y": ([0, 1, 2], [1, -1, -1])}
"""Which coordinate of the file is x, y and z in the world, and its sign, by what is up there."""


def placed_in_world(
    data: bytes, vertices: NDArray[np.float64], faces: NDArray[np.int64], merged: bool = True
) -> TriangleMesh:
    """Return the mesh of a GLB file as it was before it was turned, shifted and split along creases and seams.

    If not `merged`, it remains split.

    Only a file that says its shift is one of ours; others are as they are.
    """
    (length,) = struct.unpack_from("<I", data, 12)
    nodes = json.loads(data[20 : 20 + length]).get("nodes", [])
    extras = nodes[0].get("extras") if len(nodes) == 1 else None
    if not isinstance(extras, dict) or extras.get("up") != "y" or "shift" not in extras:
        return vertices, faces
    order, signs = AHEAD[extras.get("world_up") or "z"]
    if merged:
        distinct, first, number = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
        order_of_first = first.argsort()
        vertices, faces = distinct[order_of_first], order_of_first.argsort()[number.ravel()][faces]
    return vertices[:, order] * signs + np.asarray(extras["shift"], np.float64), faces


def colors_at(path: Path, vertices: NDArray[np.float64]) -> dict[str, NDArray[np.uint8]]:
    """Return red, green and blue (v,), sRGB, of a GLB file's vertex colours or texture at vertices read from it."""
    import trimesh

    mesh: Any = trimesh.load_mesh(path, process=False)
    if mesh.visual is None or not mesh.visual.defined:
        return {}
    textured = mesh.visual.kind == "texture"
    visual = mesh.visual.to_color() if textured else mesh.visual
    colors = np.asarray(visual.vertex_colors)[:, :3]
    if not textured:  # light, by the standard
        colors = np.rint(255 * srgb_of_linear(colors / 255.0)).astype(np.uint8)
    at = np.asarray(mesh.vertices, np.float64)
    placed, _ = placed_in_world(path.read_bytes(), at, np.empty((0, 3), np.int64), merged=False)
    nearest = _core.nearest_neighbors(np.ascontiguousarray(placed), np.ascontiguousarray(vertices), 1)[:, 0]
    return dict(zip(("red", "green", "blue"), np.ascontiguousarray(colors[nearest].T), strict=True))
