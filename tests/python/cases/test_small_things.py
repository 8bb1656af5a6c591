# SPDX-License-Identifier: GPL-3.0-or-later
"""Small things that were scanned densely, in large scenes that were not: both are there, with the detail they show."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import box, sphere_points
from helpers.raw_meshes import middles, says_it_is_a_guess, share_against

from hdpea import reconstruct

RADIUS = 0.1


@pytest.mark.parametrize("vertices", [None, 400])
def test_a_ball_above_a_floor_is_whole_and_faces_out(vertices: int | None) -> None:
    floor = np.column_stack([np.random.default_rng(0).uniform(-10, 10, (1500, 2)), np.zeros(1500)])
    middle = np.array([1.0, 2.0, 0.5])
    made = reconstruct(np.vstack([floor, middle + RADIUS * sphere_points(2500, 1)]), vertices=vertices)
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (2, 1, 0)
    assert mesh.vertices == pytest.approx(vertices or 500, abs=3)
    assert made.report.agreement.points_without_mesh == 0
    offsets = made.vertices[made.faces].mean(axis=1) - middle
    of_ball = np.linalg.norm(offsets, axis=1) < 2 * RADIUS
    assert of_ball.mean() > 0.5
    np.testing.assert_allclose(np.linalg.norm(offsets[of_ball], axis=1), RADIUS, rtol=0.05)
    out = np.where(of_ball[:, None], offsets, [0.0, 0.0, 1.0])
    assert share_against(made, out) == 0
    assert not made.report.missed


def test_of_a_thing_in_a_closed_room_it_is_said_that_the_sides_are_a_guess() -> None:
    room = box(6000, (10, 8, 4))[0]
    room_and_ball = np.vstack([room, 0.6 * sphere_points(400, 1)])
    made = reconstruct(room_and_ball)
    assert (made.report.mesh.components, made.report.mesh.closed) == (2, True)
    assert says_it_is_a_guess(made)
    # Sensors decide: the walls face what stands in the room, the ball away from its middle.
    sensors = np.vstack([np.tile([3.0, 2.0, 1.0], (6000, 1)), 1.2 * sphere_points(400, 1)])
    seen = reconstruct(room_and_ball, sensors=sensors)
    assert not says_it_is_a_guess(seen)
    assert share_against(seen, middles(seen) * np.where(abs(middles(seen)).max(axis=1) < 1, 1, -1)[:, None]) < 0.001


@pytest.mark.parametrize("far", [3.0, 30.0, 3e3, 1e5])
def test_a_small_thing_far_away_changes_nothing(far: float) -> None:
    ball, thing = sphere_points(4000, 1), 0.02 * sphere_points(60, 2) + [far, 2 * far, 0]
    made = reconstruct(np.vstack([ball, thing]))
    mesh = made.report.mesh
    assert (mesh.components, mesh.closed, mesh.self_intersections) == (1, True, 0)
    np.testing.assert_allclose(np.linalg.norm(made.vertices, axis=1), 1, rtol=0.02)
