# SPDX-License-Identifier: GPL-3.0-or-later
"""Mending faces that cut others, which the fit to noisy points leaves here and there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.linked import first_linked
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.extraction import Mesh

FARTHEST = 0.4
"""How far from the mesh a point may get by mending, in spacings of the vertices.

With 0.5, flex_hose and goblet_top have 20 and 13 pairs of faces fewer that cut each other, but their farthest points
are 1.3 and 1.2 times as far."""

LEFT_BEHIND, MOST_LOST = 1.0, 0.025
"""Distance, in spacings of the vertices, from which a vertex is left behind by a repair, and the share of them that one
of a mesh of rough points may leave: those of 60 raw clouds take a fiftieth at most, but for two with walls that pass
through each other."""

ISLAND = 16
"""Faces from which on a piece that mending has cut off stays: fewer are what was left between two layers."""


def repair_mesh(mesh: Mesh, points: NDArray[np.float64], *, exact: bool = True) -> Mesh:
    """Return the mesh without its self-intersections, but for those that could be mended only by losing points.

    These are where the walls of thin parts pass through each other. Rough points leave cuts in many places, and say
    less about what is lost: there all are mended, unless that leaves much of the mesh behind.

    Parameters
    ----------
    points
        (n, 3) float64, in the unit frame: what the mesh is to stay near.
    exact
        Whether the points are free of noise, and their normals their own.
    """
    spacing = np.sqrt(mesh_area(mesh.vertices_in_unit, mesh.faces) / len(mesh.vertices_in_unit))
    with core_errors_translated():
        repaired = _repaired(mesh, points, FARTHEST * spacing if exact else np.inf)
        if not exact:
            left = _core.closest_surface_points(
                repaired.vertices_in_unit, repaired.faces, mesh.vertices_in_unit
            ).distance
            if (left > LEFT_BEHIND * spacing).mean() > MOST_LOST:
                repaired = _repaired(mesh, points, FARTHEST * spacing)
            repaired = _without_islands(repaired, mesh)
    return repaired


def _repaired(mesh: Mesh, points: NDArray[np.float64], farthest: float) -> Mesh:
    repaired = _core.repair_self_intersections(mesh.vertices_in_unit, mesh.faces, points, farthest)
    same = _core.nearest_neighbors(mesh.vertices_in_unit, repaired.vertices, 1)[:, 0]
    return replace(
        mesh,
        vertices_in_unit=repaired.vertices,
        faces=repaired.faces,
        coordinates=mesh.coordinates[same],
        self_intersections=repaired.self_intersections,
    )


def _without_islands(repaired: Mesh, mesh: Mesh) -> Mesh:
    """Return the mesh without the small pieces that were part of larger ones before it was repaired."""
    sizes = _piece_sizes(repaired)
    small = sizes < ISLAND
    if not small.any():
        return repaired
    corners = repaired.faces[small, 0]
    before = np.zeros(len(mesh.vertices_in_unit), dtype=np.int64)
    before[mesh.faces] = _piece_sizes(mesh)[:, None]
    same = _core.nearest_neighbors(mesh.vertices_in_unit, repaired.vertices_in_unit[corners], 1)[:, 0]
    kept = np.ones(len(sizes), dtype=bool)
    kept[small] = before[same] < ISLAND
    return repaired.of_faces(repaired.faces[kept])


def _piece_sizes(mesh: Mesh) -> NDArray[np.int64]:
    """Return of how many faces the piece of each face is, (f,)."""
    first, second, third = mesh.faces.T
    labels = first_linked(len(mesh.vertices_in_unit), np.r_[first, second], np.r_[second, third])[first]
    return np.asarray(np.bincount(labels)[labels])
