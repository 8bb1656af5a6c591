# SPDX-License-Identifier: GPL-3.0-or-later
"""The closed surface in a mesh file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import CannotReconstruct, UnreadableInput
from hdpea.geometry.triangles import TriangleMesh
from hdpea.reading.triangle_mesh import SURFACE_HINT, parse_triangle_mesh


def read_surface(path: Path) -> TriangleMesh:
    """Return the vertices (v, 3) float64 and faces (f, 3) int64 of a closed surface, its normals outward.

    Equal vertices are merged, since some formats repeat them for every face; faces that become degenerate and
    vertices without faces are dropped. A surface that is inside out is reoriented.

    Raises
    ------
    UnreadableInput
        If the file is missing, damaged, or holds no faces.
    CannotReconstruct
        If the surface is not closed, manifold and consistently oriented.
    """
    vertices, faces = parse_triangle_mesh(path)
    vertices, faces = _merged(vertices, faces)
    if len(faces) == 0:
        raise UnreadableInput(f"Cannot read {path}: there are no faces in it.", SURFACE_HINT)
    if not np.isfinite(vertices).all():
        raise UnreadableInput(f"Cannot read {path}: its vertices are not finite.", "Repair the mesh.")
    _require_closed(path, vertices, faces)
    volume = np.einsum("fc,fc->", vertices[faces[:, 0]], np.cross(vertices[faces[:, 1]], vertices[faces[:, 2]]))
    return vertices, faces if volume >= 0 else faces[:, ::-1].copy()


def _merged(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> TriangleMesh:
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
