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


def is_height_field(mesh: Mesh) -> bool:
    """Say whether a mesh has one height over each place of x and y: whether its faces all face up, or all down."""
    vectors = area_vectors(mesh.vertices_in_unit, mesh.faces)
    total, in_plan = np.linalg.norm(vectors, axis=1).sum(), abs(vectors[:, 2]).sum()
    turned = min(vectors[:, 2].clip(0).sum(), (-vectors[:, 2]).clip(0).sum())
    return bool(in_plan >= LEAST_LEVEL * total > 0 and turned <= MOST_TURNED * in_plan)


def height_differences(mesh: Mesh, surface: Surface) -> NDArray[np.float64]:
    """Return how high each point (n,) of a surface is above a height field, in the unit frame.

    Negative below it, and NaN where nothing is above or below the point. Where faces lie above each other any of them
    counts, so that the difference is never smaller than that from the nearer.
    """
    in_plan = np.array([1.0, 1.0, 0.0])
    feet = _core.closest_surface_points(mesh.vertices_in_unit * in_plan, mesh.faces, surface.points_in_unit * in_plan)
    at_feet = np.einsum("nk,nk->n", feet.barycentric, mesh.vertices_in_unit[mesh.faces[feet.face], 2])
    return np.where(feet.distance <= OUTSIDE, surface.points_in_unit[:, 2] - at_feet, np.nan)
