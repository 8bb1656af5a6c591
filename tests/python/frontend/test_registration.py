# SPDX-License-Identifier: GPL-3.0-or-later
"""Two scans that do not meet are moved together; the sides of walls, and a single scan, stay where they are."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds
from helpers.clouds import Array

from hdpea.frontend.registration import moved_together

TURN, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
SPACING = (4 * np.pi**2 * 0.4 / 4000) ** 0.5
"""Of 4,000 points of a torus."""


def two_tori(move: Array) -> Array:
    """Return two scans of a torus, one of them moved."""
    return np.vstack([clouds.torus(4000, 1)[0], clouds.torus(4000, 2)[0] + move])


@pytest.mark.parametrize("spacings", [0.7, 1.5, 2.2])
def test_what_one_scan_was_moved_by_is_undone(spacings: float) -> None:
    move = spacings * SPACING * np.array([0.6, 0.48, 0.64])
    points = two_tori(move)
    met = moved_together(points)
    assert met is not None
    # Half of the way each; where a motion is along the surface, no layer tells to which scan points belong.
    ways = met.points - points
    assert np.median(np.linalg.norm(ways[:4000] - move / 2, axis=1)) < 0.15 * SPACING
    assert np.median(np.linalg.norm(ways[4000:] + move / 2, axis=1)) < 0.15 * SPACING
    assert 0.3 * spacings * SPACING < met.apart < spacings * SPACING


def test_it_does_not_matter_where_the_scans_are_and_how_large() -> None:
    points = two_tori(np.array([0, SPACING, SPACING]))
    met, elsewhere = moved_together(points), moved_together(1000 * points @ TURN.T + 1e5)
    assert met is not None
    assert elsewhere is not None
    assert elsewhere.apart == pytest.approx(1000 * met.apart, rel=1e-3)
    off = np.linalg.norm((elsewhere.points - 1e5) @ TURN / 1000 - met.points, axis=1)
    assert np.quantile(off, 0.95) < 1e-3 * SPACING


@pytest.mark.parametrize("noise", [0, 0.3])
def test_a_single_scan_is_left_alone(noise: float) -> None:
    points = clouds.torus(4000)[0]
    assert moved_together(points + noise * SPACING * np.random.default_rng(1).normal(size=points.shape)) is None


@pytest.mark.parametrize("thick", [0.7, 1.5, 2.5])
def test_the_sides_of_walls_are_no_two_scans(thick: float) -> None:
    assert moved_together(clouds.hollow_sphere(6000, spacings_thick=thick)[0]) is None
    # Parallel sheets might be, but plates are more common.
    assert moved_together(clouds.two_sheets(4000, spacings_apart=thick, facing=-1)[0]) is None


def test_few_points_are_left_alone() -> None:
    assert moved_together(clouds.sphere(60)[0]) is None
