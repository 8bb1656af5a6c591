# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of vertices and their faces as binary PLY."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.lib.recfunctions import repack_fields
from numpy.typing import NDArray
from plyfile import PlyData, PlyElement

from hdpea.writing.content import MeshContent


def ply(vertex: NDArray[np.void], faces: NDArray[np.int64] | None = None, comments: Sequence[str] = ()) -> bytes:
    """Return the content of a PLY file of a table (n,) of vertices, and of faces (f, 3) if any."""
    elements, body = [PlyElement.describe(vertex, "vertex")], vertex.tobytes()
    if faces is not None:
        # The library writes lists one by one; every list here is three long, which makes it a table.
        table = np.empty(len(faces), [("count", "u1"), ("vertex_indices", "<i4", 3)])
        table["count"], table["vertex_indices"] = 3, faces
        body += table.tobytes()
        elements.append(PlyElement.describe(repack_fields(table[["vertex_indices"]]), "face"))
    header: str = PlyData(elements, byte_order="<", comments=list(comments)).header
    return f"{header}\n".encode() + body


def mesh_ply(mesh: MeshContent) -> bytes:
    """Return the content of a PLY file of a mesh and its attributes."""
    others = [(name, column.dtype) for name, column in mesh.columns.items()]
    table = np.empty(len(mesh.vertices), [*((axis, np.dtype("<f8")) for axis in "xyz"), *others])
    table["x"], table["y"], table["z"] = mesh.vertices.T
    for name, column in mesh.columns.items():
        table[name] = column
    return ply(table, mesh.faces)
