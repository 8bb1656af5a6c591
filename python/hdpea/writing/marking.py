# SPDX-License-Identifier: GPL-3.0-or-later
"""The mark of ``hdpea.runtime.marks`` in files of points and meshes, where no program stumbles over it."""

from __future__ import annotations

import json
import struct
import zipfile
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from hdpea.runtime.marks import mark_of

STL_HEADER = 80
"""Bytes of a binary STL before its triangles, for anything."""

GLB_HEADER = struct.Struct("<4sIIII")
"""Of a GLB: magic, version, bytes in all; then bytes and type of its first chunk, which is JSON."""


def marked(content: bytes, extension: str, kind: str = "mesh") -> bytes:
    """Return the content of a PLY, OBJ, OFF, STL, VTP or GLB file with its mark."""
    mark = mark_of(kind).encode()
    match extension:
        case ".ply":
            start, format_line, rest = content.split(b"\n", 2)
            return b"\n".join([start, format_line, b"comment " + mark, rest])
        case ".obj":
            return b"# " + mark + b"\n" + content
        case ".off":
            # At the end, where no program looks any more: not all of them know comments.
            return content + b"# " + mark + b"\n"
        case ".stl":
            return _marked_stl(content, mark)
        case ".vtp":
            return content.replace(b"<VTKFile", b"<!-- " + mark + b" -->\n<VTKFile", 1)
        case _:
            return _marked_glb(content, mark.decode())


def _marked_stl(content: bytes, mark: bytes) -> bytes:
    if content.startswith(b"solid"):
        return b"solid " + mark + b"\n" + content.split(b"\n", 1)[1]
    return mark.ljust(STL_HEADER, b"\0") + content[STL_HEADER:]


def _marked_glb(content: bytes, mark: str) -> bytes:
    magic, version, size, length, kind = GLB_HEADER.unpack_from(content)
    end = GLB_HEADER.size + length
    tree = json.loads(content[GLB_HEADER.size : end])
    tree["asset"]["generator"] = mark
    text = json.dumps(tree, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return GLB_HEADER.pack(magic, version, size + len(text) - length, len(text), kind) + text + content[end:]


def save_arrays(file: Path | BinaryIO, kind: str, **arrays: Any) -> None:
    """Write arrays by name as an NPZ file with the mark of its kind."""
    np.savez(file, **arrays)
    with zipfile.ZipFile(file, "a") as archive:
        archive.comment = mark_of(kind).encode()
