# SPDX-License-Identifier: GPL-3.0-or-later
"""The surface in a mesh file, if it has an inside and an outside."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import CannotReconstruct, UnreadableInput
from hdpea.reading import DAMAGE, read_bytes

Surface = tuple[NDArray[np.float64], NDArray[np.int64]]

SURFACE_FORMATS = (".ply", ".obj", ".stl", ".off", ".glb", ".npz")
_HINT = f"Meshes are {', '.join(each[1:].upper() for each in SURFACE_FORMATS)} (arrays vertices and facets)."


def read_surface(path: Path) -> Surface:
    """Return the vertices (v, 3) float64 and faces (f, 3) int64 of a closed surface, its normals outward.

    Equal vertices are merged, since some formats repeat them for every face; faces that lose their area and
    vertices without faces are dropped. A surface that is inside out is turned.

    Raises
    ------
    UnreadableInput
        If the file is missing, damaged, or holds no faces.
    CannotReconstruct
        If the surface is not closed, manifold and of one orientation.
    """
    data = read_bytes(path)
    try:
        vertices, faces = _parse(data, path.suffix.lower())
    except DAMAGE as error:
        raise UnreadableInput(f"Cannot read {path}: it is no mesh, or damaged ({error}).", _HINT) from error
    vertices, faces = _merged(vertices, faces)
    if len(faces) == 0:
        raise UnreadableInput(f"Cannot read {path}: there are no faces in it.", _HINT)
    if not np.isfinite(vertices).all():
        raise UnreadableInput(f"Cannot read {path}: its vertices are not finite.", "Repair the mesh.")
    _require_closed(path, vertices, faces)
    volume = np.einsum("fc,fc->", vertices[faces[:, 0]], np.cross(vertices[faces[:, 1]], vertices[faces[:, 2]]))
    return vertices, faces if volume >= 0 else faces[:, ::-1].copy()


def _parse(data: bytes, suffix: str) -> Surface:
    if suffix not in SURFACE_FORMATS:
        raise ValueError(f"the extension {suffix!r} is unknown")
    if suffix == ".npz":
        with np.load(io.BytesIO(data), allow_pickle=False) as arrays:
            return arrays["vertices"].astype(np.float64), arrays["facets"].astype(np.int64)
    import trimesh

    options = {"skip_materials": True} if suffix == ".obj" else {}
    mesh = trimesh.load_mesh(io.BytesIO(data), file_type=suffix[1:], process=False, **options)
    return np.asarray(mesh.vertices, np.float64), np.asarray(mesh.faces, np.int64)


def _merged(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> Surface:
    used, faces = np.unique(faces, return_inverse=True)
    distinct, faces_of_distinct = np.unique(vertices[used], axis=0, return_inverse=True)
    corners = faces_of_distinct.ravel()[faces.reshape(-1, 3)]
    a, b, c = corners.T
    return distinct, corners[(a != b) & (b != c) & (c != a)]


def _require_closed(path: Path, vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
    from hdpea import _core

    check = _core.check_mesh(vertices, faces)
    for count, defect in (
        (check.boundary_edges, "edges at holes"),
        (check.nonmanifold_edges, "edges of more than two faces"),
        (check.inconsistent_edges, "edges between faces of opposite orientation"),
    ):
        if count:
            raise CannotReconstruct(f"{path} is not a closed, manifold surface: {count} {defect}.", "Repair the mesh.")
