# SPDX-License-Identifier: GPL-3.0-or-later
"""The unit frame: there and back without loss, whatever the place and the unit."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea.errors import CannotReconstruct
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options.lengths import Length

UTM = np.array([448_251.9, 5_411_932.7, 312.4])
"""Easting, northing and height in metres, as georeferenced scans have them."""


@pytest.mark.parametrize(("scale", "place"), [(1.0, UTM), (1e-3, UTM), (1e6, UTM), (1.0, np.full(3, 1e7))])
def test_there_and_back_costs_less_than_a_millionth_of_the_spacing(scale: float, place: np.ndarray) -> None:
    points = place + scale * clouds.torus(5000)[0]
    # Doubles at that place cannot hold a point any better than this, whatever is done with it.
    rounding = np.spacing(np.abs(points).max())
    frame = UnitFrame.around(points)
    spacing = scale * (4 * np.pi**2 * 0.4 / 5000) ** 0.5
    error = np.abs(frame.to_world(frame.to_unit(points)) - points).max()
    assert error <= max(1e-6 * spacing, rounding)


def test_the_cloud_is_centred_and_its_diagonal_is_one() -> None:
    points = UTM + clouds.box(1000, (2, 3, 6))[0]
    in_unit = UnitFrame.around(points).to_unit(points)
    np.testing.assert_allclose(in_unit.min(axis=0), -in_unit.max(axis=0), atol=1e-9)
    assert np.linalg.norm(np.ptp(in_unit, axis=0)) == pytest.approx(1)


def test_lengths_are_shares_of_the_diagonal() -> None:
    frame = UnitFrame.around(np.array([[0.0, 0, 0], [3, 4, 0]]))
    assert frame.length_to_unit(Length(0.5)) == pytest.approx(0.1)
    assert frame.length_to_unit(Length(2, percent=True)) == pytest.approx(0.02)


def test_equal_points_have_no_frame() -> None:
    with pytest.raises(CannotReconstruct, match="equal"):
        UnitFrame.around(np.ones((5, 3)))
