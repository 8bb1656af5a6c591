# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a mesh is one of its points: told by what of either lies alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from helpers import clouds

from hdpea import reconstruct
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.extraction import Mesh
from hdpea.options import MeshingOptions, Options
from hdpea.report.agreement import MOST_MISSING, Agreement, agreement_of
from hdpea.surface.surface import Surface

IN_THE_WORLD = UnitFrame(np.zeros(3), 1.0)


def square(low: float, high: float) -> Mesh:
    """Return the part of the plane z = 0 with x and y between two bounds."""
    corners = np.array([[low, low, 0], [high, low, 0], [high, high, 0], [low, high, 0]], dtype=np.float64)
    return Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), corners)


def flat(count: int = 4000) -> Surface:
    """Return points of the plane z = 0 with x and y between 0 and 1."""
    return Surface.of(IN_THE_WORLD, *clouds.plane(count))


def test_a_mesh_on_its_points_agrees() -> None:
    found = agreement_of(square(0, 1), flat(), vertices=500)
    assert found == Agreement(0, 0)
    assert list(found.missed()) == []


def test_points_that_no_mesh_is_near() -> None:
    found = agreement_of(square(0, 0.5), flat(), vertices=500)
    # Not quite three quarters, as the mesh is near beyond its border.
    assert 0.6 < found.points_without_mesh < 0.75
    assert found.area_without_points == 0
    assert [f"{found.points_without_mesh:.0%} of the points have no mesh near."] == list(found.missed())


def test_area_that_no_point_is_near_unless_it_closes_a_hole() -> None:
    mesh, surface = square(0, 2), flat()
    found = agreement_of(mesh, surface, vertices=500)
    assert found.points_without_mesh == 0
    assert 0.6 < found.area_without_points < 0.75
    assert "of the mesh's area has no points near" in " ".join(found.missed())
    patches = mesh.vertices_in_unit[mesh.faces]
    assert agreement_of(replace(mesh, patches=patches), surface, vertices=500) == Agreement(0, 0)


def test_what_is_near_follows_the_number_of_vertices() -> None:
    raised = square(0, 1)
    raised.vertices_in_unit[:, 2] += 0.1
    shares = [agreement_of(raised, flat(), vertices).points_without_mesh for vertices in (500, 100, 20)]
    assert shares[0] > 0.95
    assert shares[0] >= shares[1] >= shares[2] < 0.01


@pytest.mark.parametrize("vertices", [30, 400])
def test_a_hole_that_is_closed_on_purpose_is_not_missed(vertices: int) -> None:
    points, normals = clouds.sphere(4000)
    bowl = points[:, 2] < 0.2
    options = Options(meshing=MeshingOptions(vertices=vertices, watertight=True))
    report = reconstruct(points[bowl], normals[bowl], options).report
    assert report.missed == []
    assert report.agreement.area_without_points < 0.01


def test_wires_thinner_than_their_points_are_apart_are_missed() -> None:
    random = np.random.default_rng(0)
    angle, along = 2 * np.pi * random.random(1500), 20 * random.random((3, 500))
    wires = np.column_stack([along.ravel(), np.repeat([0, 4, 8], 500), np.zeros(1500)])
    wires[:, 1:] += 0.01 * np.column_stack([np.cos(angle), np.sin(angle)])
    ball, _ = clouds.sphere(1500)
    report = reconstruct(np.vstack([wires, ball - [0, 9, 0]])).report
    assert report.agreement.points_without_mesh > MOST_MISSING
    assert "of the points have no mesh near" in " ".join(report.missed)
