# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds that cannot come out whole: it is said, and never exit code 0."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from helpers.raw_clouds import cables_and_a_pole, solid_ball, spacing_of, voxels_of_a_ball

from hdpea import reconstruct
from hdpea.frontend.roughness import roughness_of
from hdpea.frontend.volume import fills_a_volume


@pytest.mark.parametrize(
    "points", [cables_and_a_pole(800, seed=1), cables_and_a_pole(1500), cables_and_a_pole(3000, radius=0.005, seed=2)]
)
def test_cables_that_pass_for_scan_lines_are_missed(points: np.ndarray) -> None:
    assert any("were left out as strays" in sentence for sentence in reconstruct(points).report.missed)


def test_cables_thinner_than_their_points_are_apart_are_missed() -> None:
    made = reconstruct(cables_and_a_pole(4000))
    assert any("have no mesh near" in sentence for sentence in made.report.missed)


@pytest.mark.parametrize("points", [solid_ball(6000), voxels_of_a_ball(16)])
def test_points_that_fill_a_volume_show_no_surface(points: np.ndarray) -> None:
    assert any("fill a volume" in sentence for sentence in reconstruct(points).report.missed)


@pytest.mark.parametrize("spacings", [0.0, 1.0, 2.0])
def test_a_noisy_surface_fills_no_volume(spacings: float) -> None:
    noise = np.random.default_rng(0).normal(0, spacings * spacing_of(8000), (8000, 1))
    points = sphere_points(8000, 1) * (1 + noise)
    assert not fills_a_volume(points, roughness_of(points))
