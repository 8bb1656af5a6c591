# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates stored in 32 bits far from the origin are told; all others are left alone."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import Array, sphere_points

from hdpea.frontend.cleaning import surface_cloud
from hdpea.frontend.precision import precision_note
from hdpea.options import CleaningOptions
from hdpea.reading.cleaning import cleaned
from hdpea.reading.cloud import PointCloud

FAR = 500_000.0
"""Where 32-bit numbers have steps of 1/32."""


def in_32_bits(points: Array) -> Array:
    return np.unique(points.astype(np.float32).astype(np.float64), axis=0)


def test_coarse_steps_are_told_whatever_else_is_wanted() -> None:
    cloud = cleaned(PointCloud(in_32_bits(FAR + sphere_points(4000))))
    for outliers in ("auto", "none"):
        (note,) = [each for each in surface_cloud(cloud, CleaningOptions(outliers)).notes if "32-bit" in each]
        assert "steps of 0.031" in note
        assert "subtract an offset" in note


@pytest.mark.parametrize(
    "points",
    [
        pytest.param(FAR + sphere_points(4000), id="of 64 bits"),
        pytest.param(in_32_bits(sphere_points(4000)), id="near the origin"),
        pytest.param(in_32_bits(FAR + 100 * sphere_points(4000)), id="large"),
        pytest.param(
            FAR + np.stack(np.meshgrid(np.arange(40.0), np.arange(40.0), [0.0]), -1).reshape(-1, 3), id="grid"
        ),
        pytest.param(np.array([[0.0, 0.0, 0.0]]), id="a single point"),
        pytest.param(1e300 * sphere_points(30), id="huge"),
    ],
)
def test_others_are_not(points: Array) -> None:
    assert precision_note(np.ascontiguousarray(points)) is None
