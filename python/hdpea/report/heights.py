# SPDX-License-Identifier: GPL-3.0-or-later
"""Heights of points above a mesh of terrain: what surveyors state, where distances are at a right angle to the mesh."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.triangles import area_vectors
from hdpea.mesh.extraction import Mesh
from hdpea.surface.surface import Surface

MOST_TURNED = 0.01
"""Largest share of the area in plan that may face the other way than the rest, as where noise folds a slope."""

LEAST_LEVEL = 0.5
"""Least area in plan, of all area: that of a slope of 60 degrees."""

OUTSIDE = 1e-9
"""Distance from the mesh in plan, in diagonals, from which on nothing is above or below a point."""

FLATTENED = 1e-4
"""What heights are scaled by to find the place above or below: distances in plan go first, then those along z."""

STEEPEST = 10.0
"""How many times as long along z as the shortest way to the mesh may be: on a slope of 84 degrees. What is farther is
another layer, as the ground is below the eaves."""


def is_height_field(mesh: Mesh) -> bool:
    """Say whether a mesh has one height over each place of x and y: whether its faces all face up, or all down."""
    vectors = area_vectors(mesh.vertices_in_unit, mesh.faces)
    total, in_plan = np.linalg.norm(vectors, axis=1).sum(), abs(vectors[:, 2]).sum()
    turned = min(vectors[:, 2].clip(0).sum(), (-vectors[:, 2]).clip(0).sum())
    return bool(in_plan >= LEAST_LEVEL * total > 0 and turned <= MOST_TURNED * in_plan)


def height_differences(mesh: Mesh, surface: Surface, distances: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how high each point (n,) of a surface is above a height field, in the unit frame.

    Negative below it, and NaN where nothing is above or below the point, but for layers that are far. Where parts of
    the mesh lie above each other the nearest counts. `distances` (n,) are those of the points from the mesh.
    """
    scale = np.array([1.0, 1.0, FLATTENED])
    feet = _core.closest_surface_points(mesh.vertices_in_unit * scale, mesh.faces, surface.points_in_unit * scale)
    at_feet = np.einsum("nk,nkc->nc", feet.barycentric, mesh.vertices_in_unit[mesh.faces[feet.face]])
    differences = surface.points_in_unit - at_feet
    above = differences[:, 2]
    outside = np.linalg.norm(differences[:, :2], axis=1) > OUTSIDE + FLATTENED * abs(above)
    return np.where(outside | (abs(above) > STEEPEST * distances + OUTSIDE), np.nan, above)
