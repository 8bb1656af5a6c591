# SPDX-License-Identifier: GPL-3.0-or-later
"""What surveyors state of terrain: how far points are above or below the mesh, along z."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds
from helpers.clouds import Array

from hdpea import reconstruct
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.extraction import Mesh
from hdpea.report.heights import height_differences, is_height_field
from hdpea.report.summary import summarize
from hdpea.surface.surface import Surface

STEPS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 1], [1, 1, 1], [2, 0, 1.0], [2, 1, 1]])
STAIR = Mesh(STEPS, np.array([[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2], [4, 6, 7], [4, 7, 5]]), STEPS)


def surface_of(points: Array) -> Surface:
    return Surface.of(UnitFrame(np.zeros(3), 1.0), points, np.tile([0, 0, 1.0], (len(points), 1)))


def test_heights_are_along_z_and_unknown_beside_the_mesh() -> None:
    points = np.array([[0.5, 0.4, 0.1], [1.5, 0.4, 0.7], [3, 0, 0]])
    found = height_differences(STAIR, surface_of(points), np.array([0.1, 0.3, 1]))
    np.testing.assert_allclose(found, [0.1, -0.3, np.nan], atol=1e-6)


def test_of_layers_the_nearest_counts_and_not_what_lies_below_the_eaves() -> None:
    ground = np.array([[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0.0]])
    roof = ground / 3 + [3, 3, 1]
    square = np.array([[0, 1, 2], [0, 2, 3]])
    layers = np.concatenate([ground, roof])
    house = Mesh(layers, np.concatenate([square, 4 + square]), layers)
    points = surface_of(np.array([[4, 4, 0.1], [4, 4, 0.9], [2.95, 4, 1]]))
    found = height_differences(house, points, np.array([0.1, 0.1, 0.05]))
    np.testing.assert_allclose(found, [0.1, -0.1, np.nan], atol=1e-6)


def test_what_faces_up_everywhere_is_a_height_field() -> None:
    upside_down, upright = Mesh(STEPS, STAIR.faces[:, ::-1], STEPS), Mesh(STEPS[:, [1, 2, 0]], STAIR.faces, STEPS)
    assert is_height_field(STAIR)
    assert is_height_field(upside_down)
    assert not is_height_field(upright)


@pytest.mark.parametrize("slope", [0.0, 1.0])
def test_terrain_has_heights_in_its_report_and_its_summary(slope: float) -> None:
    points = 100 * clouds.plane(1000)[0] + [4e5, 5e6, 0]
    points[:, 2] += slope * (points[:, 0] - 4e5) + 3 * np.sin(points[:, 1] / 9)
    made = reconstruct(points, vertices=60)
    told = made.report.as_json()["distances"]
    # On a slope of 45 degrees what is so far off at a right angle is 1.4 times as far along z.
    ratio = told["along_z"]["rms"] / told["in_world_units"]["rms"]
    assert np.sqrt(1 + slope**2) <= ratio < 1.3 * np.sqrt(1 + slope**2)
    assert told["along_z"]["percentile_95"] <= told["along_z"]["max"]
    assert 900 < told["along_z"]["points"] == 1000 - told["along_z"]["others"]
    assert "along z: rms" in summarize(made.report, "mesh.ply")


def test_a_ball_has_none() -> None:
    made = reconstruct(*clouds.sphere(600), vertices=60)
    assert made.report.as_json()["distances"]["along_z"] is None
    assert "along z" not in summarize(made.report, "mesh.ply")
