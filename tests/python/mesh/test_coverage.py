# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles lie on points that face as they do."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from helpers import clouds
from helpers.reconstructions import mesh_of

from hdpea import _core
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.coverage import covered
from hdpea.mesh.particles import Particles
from hdpea.options import MeshingOptions, NormalOptions, Options
from hdpea.reconstruction import reconstruct
from hdpea.surface.surface import Surface

POINTS = 3000
AS_GIVEN = Options(normals=NormalOptions(orient="file"), meshing=MeshingOptions(vertices=600))
CORNERS = np.array([[0.2, 0.5, 0], [0.8, 0.5, 0], [0.5, 0.8, 0]])


def kept(points: clouds.Array, normals: clouds.Array, corners: clouds.Array = CORNERS) -> bool:
    """Whether the triangle of three places of a plane is kept, as one of a mesh of 100 vertices."""
    surface = Surface.of(UnitFrame(np.zeros(3), 1.0), points, normals)
    others = points[:: len(points) // 97][:97]
    particles = np.vstack([corners, others])
    nearest = _core.nearest_neighbors(points, particles, 1)[:, 0]
    nearest[:3] = [np.argmin(np.linalg.norm(points - corner, axis=1) - (normals[:, 2] > 0)) for corner in corners]
    candidates = _core.Candidates(np.array([[0, 1, 2]]), np.array([3], np.int32), np.zeros(100))
    return len(covered(candidates, Particles(particles, nearest), surface).triangles) == 1


def test_a_triangle_on_points_is_kept() -> None:
    points, normals = clouds.plane(POINTS)
    assert kept(points, normals)
    assert kept(points, normals, CORNERS[::-1].copy())


@pytest.mark.parametrize(("width", "crossed"), [(0.1, True), (0.4, False)])
def test_a_gap_of_the_points_is_crossed_only_if_it_is_narrow(width: float, crossed: bool) -> None:
    points, normals = clouds.plane(POINTS)
    left = abs(points[:, 0] - 0.5) > width / 2  # the spacing of 100 vertices is 0.1
    assert kept(points[left], normals[left]) == crossed


def test_a_triangle_needs_points_of_its_own_side() -> None:
    points, normals = clouds.plane(POINTS)
    at_corners = np.linalg.norm(points[:, None] - CORNERS, axis=2).min(axis=1) < 0.05
    assert not kept(points, np.where(at_corners[:, None], normals, -normals))


def test_one_side_of_a_thin_wall_is_covered_however_near_the_other_is() -> None:
    points, normals = clouds.two_sheets(2 * POINTS, spacings_apart=0.1, facing=-1)
    assert kept(points, normals)


@pytest.mark.parametrize("share", [0.02, 0.05])
@pytest.mark.parametrize("shape", [clouds.sphere, clouds.torus])
def test_points_that_are_turned_the_wrong_way_make_no_surface_of_their_own(
    shape: Callable[[int], clouds.Cloud], share: float
) -> None:
    points, normals = shape(2 * POINTS)
    turned = np.random.default_rng(0).random(len(points)) < share
    normals = np.where(turned[:, None], -normals, normals)
    found = reconstruct(points, normals, AS_GIVEN).report.mesh
    assert found is not None
    assert (found.components, found.closed, found.self_intersections) == (1, True, 0)


def test_what_is_refused_is_told() -> None:
    assert mesh_of("plate").report.meshing["refused_uncovered"] == 0
