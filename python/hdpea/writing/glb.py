# SPDX-License-Identifier: GPL-3.0-or-later
"""GLB, the binary form of glTF 2.0 (ISO/IEC 12113), as browsers, game engines and Blender expect it."""

from __future__ import annotations

import json
import math
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.color import linear_of_srgb
from hdpea.geometry.smooth_fans import split_at_creases
from hdpea.geometry.texture import Texture
from hdpea.geometry.triangles import vertex_normals
from hdpea.geometry.unit_frame import diagonal_of

FLOAT32_LEAST, FLOAT32_MOST = 1e-30, 1e30
"""Sizes of meshes between which single precision has all its digits for their details, too."""

MATERIAL: dict[str, Any] = {
    "name": "surface",
    "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.9},
    # What was scanned from one side is seen from the other, too.
    "doubleSided": True,
}

_JSON, _BIN = 0x4E4F534A, 0x004E4942
_COMPONENTS = {"float32": 5126, "uint16": 5123, "uint32": 5125}
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963


def glb(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    colors: NDArray[np.uint8] | None = None,
    texture: Texture | None = None,
    image: bytes | None = None,
    extras: dict[str, Any] | None = None,
) -> bytes:
    """Return the content of a GLB file: one mesh with normals, a material and, if given, colours or a texture.

    Parameters
    ----------
    vertices
        (v, 3) with y up, in metres; near the origin, since the file holds single precision.
    faces
        (f, 3).
    colors
        (v, 3), sRGB. The file holds them as linear light of 16 bits, of which 8 would not tell dark colours apart.
    texture, image
        Where in the image each face lies, and the image as PNG. Programs multiply it by the colours: give one of them.
    extras
        What the node says besides; Blender shows it as custom properties.
    """
    scale = _scale_of(vertices)
    node: dict[str, Any] = {"name": "mesh"}
    if scale != 1:
        node["scale"] = [scale] * 3
    if extras:
        node["extras"] = extras
    tree = {
        "asset": {"version": "2.0", "generator": "hdpea"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [node],
    }
    buffer = _Buffer()
    if len(faces):
        node["mesh"] = 0
        tree |= _mesh(buffer, vertices / scale, faces, colors, texture)
        tree |= {"materials": [MATERIAL]} if image is None else _textured_material(buffer, image)
        tree |= buffer.described()
    text = json.dumps(tree, separators=(",", ":")).encode()
    chunks = _chunk(_JSON, text, b" ") + (_chunk(_BIN, bytes(buffer.content), b"\0") if buffer.content else b"")
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _mesh(
    buffer: _Buffer,
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    colors: NDArray[np.uint8] | None,
    texture: Texture | None,
) -> dict[str, Any]:
    """Put the arrays of a mesh into the buffer, and return the mesh."""
    # A vertex on a crease has a normal for each side, and occurs as often; and so it does on a seam of the texture.
    smooth, fans = split_at_creases(vertices, faces)
    normals = vertex_normals(vertices[smooth], fans)
    on_seams = faces if texture is None else texture.corners
    pairs, inverse = np.unique(np.stack([on_seams.ravel(), fans.ravel()], axis=1), axis=0, return_inverse=True)
    on_seam, fan = pairs.T
    corners, rows = inverse.reshape(faces.shape), smooth[fan]
    attributes = {
        "POSITION": buffer.add(vertices[rows].astype(np.float32), bounds=True),
        "NORMAL": buffer.add(normals[fan].astype(np.float32)),
    }
    if colors is not None:
        attributes["COLOR_0"] = buffer.add(_linear_16_bit(colors)[rows])
    if texture is not None:
        attributes["TEXCOORD_0"] = buffer.add(texture.places[on_seam].astype(np.float32))
    # The largest number of its type is no index: it would restart the primitive.
    narrow = corners.max() < np.iinfo(np.uint16).max
    indices = buffer.add(corners.ravel().astype(np.uint16 if narrow else np.uint32), indices=True)
    primitive = {"attributes": attributes, "indices": indices, "material": 0}
    return {"meshes": [{"name": "mesh", "primitives": [primitive]}]}


def _textured_material(buffer: _Buffer, image: bytes) -> dict[str, Any]:
    """Put an image into the buffer, and return a material that shows it."""
    surface = dict(MATERIAL["pbrMetallicRoughness"], baseColorTexture={"index": 0})
    return {
        "images": [{"bufferView": buffer.append(image), "mimeType": "image/png", "name": "texture"}],
        "textures": [{"source": 0}],
        "materials": [{**MATERIAL, "pbrMetallicRoughness": surface}],
    }


def _scale_of(vertices: NDArray[np.float64]) -> float:
    """Return by what to divide the vertices to fit single precision: a power of two, by which nothing is lost."""
    extent = diagonal_of(vertices.min(axis=0), vertices.max(axis=0)) if len(vertices) else 1.0
    return 1.0 if FLOAT32_LEAST < extent < FLOAT32_MOST else 2.0 ** math.frexp(extent)[1]


def _linear_16_bit(colors: NDArray[np.uint8]) -> NDArray[np.uint16]:
    """Return linear RGBA (v, 4): three numbers of 16 bits would not end where the next may begin."""
    light = np.append(linear_of_srgb(colors / 255.0), np.ones((len(colors), 1)), axis=1)
    return np.asarray(np.rint(65535 * light), np.uint16)


def _chunk(kind: int, content: bytes, padding: bytes) -> bytes:
    content += padding * (-len(content) % 4)
    return struct.pack("<II", len(content), kind) + content


class _Buffer:
    """The binary part of a file, and what it says is in there."""

    def __init__(self) -> None:
        self.content = bytearray()
        self.views: list[dict[str, int]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, array: NDArray[Any], bounds: bool = False, indices: bool = False) -> int:
        """Append an array (n, c), or indices (n,), and return the number of its accessor."""
        content = array.astype(array.dtype.newbyteorder("<")).tobytes()
        accessor = {
            "bufferView": self.append(content, _ELEMENT_ARRAY_BUFFER if indices else _ARRAY_BUFFER),
            "componentType": _COMPONENTS[array.dtype.name],
            "count": len(array),
            "type": "SCALAR" if array.ndim == 1 else f"VEC{array.shape[1]}",
        }
        if bounds:
            accessor |= {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}
        if array.dtype == np.uint16 and not indices:
            accessor["normalized"] = True
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def append(self, content: bytes, target: int | None = None) -> int:
        """Append bytes, and return the number of their view."""
        view = {"buffer": 0, "byteOffset": len(self.content), "byteLength": len(content)}
        self.views.append(view if target is None else {**view, "target": target})
        self.content += content + bytes(-len(content) % 4)
        return len(self.views) - 1

    def described(self) -> dict[str, Any]:
        """Return what the file says about it."""
        return {
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.content)}],
        }
