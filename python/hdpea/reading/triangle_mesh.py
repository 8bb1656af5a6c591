# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles from mesh files, whatever surface they make."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.geometry.triangles import TriangleMesh
from hdpea.reading import DAMAGE, read_bytes
from hdpea.reading.glb import placed_in_world

SURFACE_FORMATS = (".ply", ".obj", ".stl", ".off", ".glb", ".npz")
SURFACE_HINT = f"Meshes are {', '.join(each[1:].upper() for each in SURFACE_FORMATS)} (arrays vertices and facets)."


def read_triangle_mesh(path: Path) -> TriangleMesh:
    """Return the vertices (v, 3) float64 and the faces (f, 3) int64 of a mesh, as they are in the file.

    Polygons are cut into triangles. Only where each face has corners of its own, as in STL, are equal vertices
    merged: such a file knows no edges. (Elsewhere it would pinch what the file keeps apart.)

    Raises
    ------
    UnreadableInput
        If the file is missing, damaged, or holds no faces; if a corner is not finite.
    """
    vertices, faces = parse_triangle_mesh(path)
    if len(faces) == 0:
        raise UnreadableInput(f"Cannot read {path}: there are no faces in it.", SURFACE_HINT)
    used, faces = drop_unused(vertices, faces)
    if not np.isfinite(used).all():
        raise UnreadableInput(f"Cannot read {path}: its vertices are not finite.", "Repair the mesh.")
    if len(used) < 3 * len(faces):
        return used, faces
    distinct, corners = np.unique(used, axis=0, return_inverse=True)
    return distinct, corners.ravel()[faces]


def drop_unused(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> TriangleMesh:
    """Return the mesh without the vertices that have no face."""
    used, corners = np.unique(faces, return_inverse=True)
    return vertices[used], corners.reshape(-1, 3)


def parse_triangle_mesh(path: Path) -> TriangleMesh:
    """Return the vertices and faces of a file, of which there may be none where the format can hold points alone.

    Raises
    ------
    UnreadableInput
        If the file is missing, damaged, or of no mesh format.
    """
    data, suffix = read_bytes(path), path.suffix.lower()
    try:
        vertices, faces = _parse(data, suffix)
        if faces.size and not 0 <= faces.min() <= faces.max() < len(vertices):
            raise IndexError("a face has a corner that is not there")
    except DAMAGE as error:
        raise UnreadableInput(f"Cannot read {path}: it is no mesh, or damaged ({error}).", SURFACE_HINT) from error
    return vertices, faces


def _parse(data: bytes, suffix: str) -> TriangleMesh:
    if suffix not in SURFACE_FORMATS:
        raise ValueError(f"the extension {suffix!r} is unknown")
    if suffix == ".npz":
        with np.load(io.BytesIO(data), allow_pickle=False) as arrays:
            return arrays["vertices"].astype(np.float64), arrays["facets"].astype(np.int64)
    import trimesh

    options = {"skip_materials": True} if suffix == ".obj" else {}
    mesh = trimesh.load_mesh(io.BytesIO(data), file_type=suffix[1:], process=False, **options)
    vertices, faces = np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces, np.int64)
    return placed_in_world(data, vertices, faces) if suffix == ".glb" else (vertices, faces)
