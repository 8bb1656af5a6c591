# SPDX-License-Identifier: GPL-3.0-or-later
"""A few points that belong to nothing do not change the surface of all others."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from helpers.raw_clouds import with_outliers
from helpers.raw_meshes import assert_ball

from hdpea import reconstruct

POINTS = 4000


@pytest.mark.parametrize("with_normals", [False, True])
@pytest.mark.parametrize("far", [20.0, 100.0, 1e6])
def test_one_stray_point_is_left_out_and_told(far: float, with_normals: bool) -> None:
    ball = sphere_points(POINTS, 1)
    normals = np.vstack([ball, [[1, 0, 0]]]) if with_normals else None
    made = reconstruct(np.vstack([ball, [[far, 0.3 * far, 0]]]), normals)
    assert_ball(made)
    assert 1 <= made.report.counts["dropped_strays"] <= 4
    assert any("no surface" in note for note in made.report.notes)


@pytest.mark.parametrize("share", [0.003, 0.005, 0.01])
@pytest.mark.parametrize("orient", ["auto", "wnnc"])
def test_outliers_do_not_turn_it_inside_out(share: float, orient: str) -> None:
    assert_ball(reconstruct(with_outliers(POINTS, int(share * POINTS)), orient=orient))
