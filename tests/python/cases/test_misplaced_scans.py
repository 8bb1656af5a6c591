# SPDX-License-Identifier: GPL-3.0-or-later
"""Scans of one thing that are out of register: one surface between the layers, and thin walls stay walls."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import Array, sphere_points
from helpers.raw_clouds import overlapping_strips, turntable, two_scans_of_a_ball, two_scans_of_a_wall
from helpers.raw_meshes import area, assert_ball, middles, share_against

from hdpea import reconstruct
from hdpea.options import NormalOptions, Options
from hdpea.surface.layers import have_layers


@pytest.mark.parametrize("spacings", [1.0, 2.0])
def test_two_scans_of_a_ball_give_one(spacings: float) -> None:
    assert_ball(reconstruct(*two_scans_of_a_ball(2500, spacings)))


@pytest.mark.parametrize("spacings", [1.0, 2.0])
def test_two_scans_of_a_ball_without_normals_give_one(spacings: float) -> None:
    made = reconstruct(two_scans_of_a_ball(2500, spacings)[0])
    assert_ball(made)
    assert any("moved together" in note for note in made.report.notes)


@pytest.mark.parametrize("normals", ["auto", "estimate"])
def test_two_scans_with_columns_that_are_no_normals_give_one(normals: str) -> None:
    options = Options(normals=NormalOptions(normals=normals))
    points = two_scans_of_a_ball(2500, 2.0)[0]
    made = reconstruct(points, np.tile([0, 0, 1.0], (len(points), 1)), options=options)
    assert_ball(made)
    assert any("moved together" in note for note in made.report.notes)


def test_scans_stay_where_they_are_if_nothing_is_to_be_moved() -> None:
    points = two_scans_of_a_ball(1000, 1.0)[0]
    assert not any("moved together" in note for note in reconstruct(points, denoise="none").report.notes)


def test_a_wall_whose_layers_face_the_same_way_is_one_sheet() -> None:
    points, normals = two_scans_of_a_wall(2500, 1.5)
    made = reconstruct(points, normals)
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 1, 0)
    assert area(made) == pytest.approx(1, rel=0.06)
    assert share_against(made, np.array([0, 0, 1.0])) < 1e-9
    # Half way between the layers.
    assert middles(made)[:, 2].mean() == pytest.approx(0.75 / 50, rel=0.15)


@pytest.mark.parametrize("spacings", [1.0, 3.0])
def test_strips_that_overlap_are_one_sheet_that_faces_up(spacings: float) -> None:
    made = reconstruct(overlapping_strips(3000, spacings))
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 1, 0)
    assert share_against(made, np.array([0, 0, 1.0])) < 0.001
    assert not made.report.missed


@pytest.mark.parametrize("spacings", [2.0, 2.5])
def test_a_scan_whose_end_does_not_meet_its_beginning_is_one_sheet(spacings: float) -> None:
    made = reconstruct(turntable(6000, spacings))
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 2, 0)
    assert share_against(made, middles(made) * [1, 1, 0]) < 0.001
    assert not made.report.missed


def shell(apart: float, inside: float) -> tuple[Array, Array]:
    """Return the outside and the inside of a thick ball, and their normals: inside, as often the outward ones."""
    outer, inner = sphere_points(3000, 1), sphere_points(3000, 2)
    return np.vstack([outer, (1 - apart) * inner]), np.vstack([outer, inside * inner])


def test_the_sides_of_a_wall_are_no_layers_of_one_surface() -> None:
    assert not have_layers(*shell(0.1, inside=-1))
    assert have_layers(*shell(0.1, inside=1))
