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
from hdpea.geometry.upright import GLTF_FROM_WORLD


def placed_in_world(
    data: bytes, vertices: NDArray[np.float64], faces: NDArray[np.int64], merged: bool = True
) -> TriangleMesh:
    """Return the mesh of a GLB file as it was before it was turned, shifted and split along creases and seams.

    If not `merged`, it remains split.

    Only a file that says its shift is one of ours; others are as they are.
    """
    tree, _ = _described(data)
    nodes = tree.get("nodes", [])
    extras = nodes[0].get("extras") if len(nodes) == 1 else None
    if not isinstance(extras, dict) or extras.get("up") != "y" or "shift" not in extras:
        return vertices, faces
    if merged:
        distinct, first, number = np.unique(vertices, axis=0, return_index=True, return_inverse=True)
        order_of_first = first.argsort()
        vertices, faces = distinct[order_of_first], order_of_first.argsort()[number.ravel()][faces]
    # Rows times the rotation itself turn back, where the writer takes its transpose.
    turned = vertices @ GLTF_FROM_WORLD[extras.get("world_up") or "z"]
    return turned + np.asarray(extras["shift"], np.float64), faces


def colors_at(path: Path, vertices: NDArray[np.float64]) -> dict[str, NDArray[np.uint8]]:
    """Return red, green and blue (v,), sRGB, of a GLB file's vertex colours or texture at vertices read from it."""
    data = path.read_bytes()
    positions, light = _attribute(data, "POSITION"), _attribute(data, "COLOR_0")
    if positions is not None and light is not None:
        colors = np.rint(255 * srgb_of_linear(light[:, :3].clip(0, 1)))
    else:
        import trimesh

        mesh: Any = trimesh.load_mesh(path, process=False)
        if mesh.visual is None or mesh.visual.kind != "texture" or mesh.visual.uv is None:
            return {}
        positions, colors = np.asarray(mesh.vertices), np.asarray(mesh.visual.to_color().vertex_colors)[:, :3]
    placed, _ = placed_in_world(data, positions.astype(np.float64), np.empty((0, 3), np.int64), merged=False)
    nearest = _core.nearest_neighbors(np.ascontiguousarray(placed), np.ascontiguousarray(vertices), 1)[:, 0]
    return dict(zip(("red", "green", "blue"), np.ascontiguousarray(colors[nearest].astype(np.uint8).T), strict=True))


COMPONENTS: dict[int, tuple[str, int]] = {5121: ("<u1", 255), 5123: ("<u2", 65535), 5126: ("<f4", 1)}
"""Types of numbers by their names in glTF, and what counts as 1 among them."""


def _attribute(data: bytes, name: str) -> NDArray[np.float64] | None:
    """Return the numbers (v, c) of that name of the only primitive of a GLB file; None if it has more, or none such."""
    tree, numbers = _described(data)
    primitives = [each for mesh in tree.get("meshes", []) for each in mesh["primitives"]]
    if len(primitives) != 1 or name not in primitives[0]["attributes"]:
        return None
    accessor = tree["accessors"][primitives[0]["attributes"][name]]
    if accessor["componentType"] not in COMPONENTS or "bufferView" not in accessor:
        return None
    kind, largest = COMPONENTS[accessor["componentType"]]
    view, width = tree["bufferViews"][accessor["bufferView"]], int(accessor["type"].removeprefix("VEC"))
    item = np.dtype(kind).itemsize
    start = numbers + view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    strides = (view.get("byteStride", width * item), item)
    rows: NDArray[Any] = np.ndarray((accessor["count"], width), kind, data, start, strides)
    return rows / largest


def _described(data: bytes) -> tuple[dict[str, Any], int]:
    """Return what a GLB file says of itself, and where its numbers begin."""
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + length]), 28 + length
