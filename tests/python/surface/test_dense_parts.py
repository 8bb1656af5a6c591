# SPDX-License-Identifier: GPL-3.0-or-later
"""What was sampled far more densely than the scene around it is a part; denser regions of one surface are none."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea import _core
from hdpea.surface.dense_parts import dense_parts

Array = clouds.Array


def parts_of(points: Array) -> list[list[int]]:
    neighbors = _core.nearest_neighbors(points, 40)
    directions = _core.estimate_normals(points, np.ascontiguousarray(neighbors[:, :16]))
    return [rows.tolist() for rows in dense_parts(points, directions, neighbors)]


def plain(count: int) -> Array:
    """Return points of a square of side 20 about the origin, in the plane z = 0."""
    return np.column_stack([np.random.default_rng(0).uniform(-10, 10, (count, 2)), np.zeros(count)])


@pytest.mark.parametrize("height", [0.3, 1.0])
def test_a_ball_above_a_sparse_plain_is_a_part(height: float) -> None:
    ball = 0.2 * clouds.sphere(1500)[0] + [0, 0, 0.2 + height]
    assert parts_of(np.vstack([plain(1500), ball])) == [list(range(1500, 3000))]


def test_neither_turning_nor_scaling_makes_a_difference() -> None:
    ball = 0.2 * clouds.sphere(1500)[0] + [0, 0, 1]
    scene = 1e-3 * np.vstack([ball, plain(1500)])[:, [2, 0, 1]] + [3, -2, 1]
    assert parts_of(scene) == [list(range(1500))]


def test_a_denser_region_of_the_same_surface_is_none() -> None:
    assert parts_of(np.vstack([plain(1500), 0.05 * plain(1500)])) == []


def test_nor_is_anything_in_an_even_cloud_or_above_strays() -> None:
    ball = clouds.sphere(2000)[0]
    assert parts_of(ball) == []
    assert parts_of(np.vstack([ball, 30 * plain(100)])) == []
