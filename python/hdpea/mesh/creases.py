# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges of the mesh along the sharp edges that the points show."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.extraction import Mesh, mask_of
from hdpea.surface.surface import Surface

AT_CORNER = 0.1
"""Farthest that a vertex counts as at a corner, in spacings of the vertices."""


def find_creases(surface: Surface) -> _core.Creases:
    """Return the sharp edges, of 40 degrees or more, that the points of a surface show; smooth ones show none."""
    with core_errors_translated():
        return _core.find_creases(surface.points_in_unit, surface.normals)


def align_to_creases(mesh: Mesh, creases: _core.Creases, fixed: NDArray[np.bool_] | None = None) -> Mesh:
    """Return the mesh with vertices moved onto creases and edges flipped, so that no edge runs across a crease.

    A fit to the points keeps them there, as the points of both sides hold them. Manifoldness and topology stay, and so
    do `fixed` vertices (v,), if any.
    """
    with core_errors_translated():
        aligned = _core.align_to_creases(mesh.vertices_in_unit, mesh.faces, creases, mask_of(fixed))
    return replace(mesh, vertices_in_unit=aligned.vertices, faces=aligned.faces)


def at_corners(mesh: Mesh, creases: _core.Creases) -> NDArray[np.bool_]:
    """Return which vertices (v,) lie where creases meet: of each corner the nearest one, if it is near."""
    vertices, corners = mesh.vertices_in_unit, creases.corners
    nearest = _core.nearest_neighbors(vertices, corners, 1)[:, 0]
    farthest = AT_CORNER * np.sqrt(mesh_area(vertices, mesh.faces) / len(vertices))
    near = np.linalg.norm(vertices[nearest] - corners, axis=1) <= farthest
    found = np.zeros(len(vertices), dtype=bool)
    found[nearest[near]] = True
    return found


def with_crease_edges_counted(mesh: Mesh, creases: _core.Creases) -> Mesh:
    """Return the mesh with the number of its edges that run along creases among its statistics."""
    with core_errors_translated():
        edges = _core.crease_edges(mesh.vertices_in_unit, mesh.faces, creases)
    return replace(mesh, statistics=mesh.statistics | {"crease_edges": len(edges)})
