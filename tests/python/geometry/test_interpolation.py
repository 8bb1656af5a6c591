# SPDX-License-Identifier: GPL-3.0-or-later
"""Interpolation along a surface: exact where it can be, on one sheet, and never without a value."""

from __future__ import annotations

import numpy as np
from helpers import clouds

from hdpea.geometry.interpolation import Interpolation

UP = np.eye(3)[2]


def test_a_constant_stays_so_and_what_is_affine_nearly() -> None:
    random = np.random.default_rng(0)
    plane = np.column_stack([random.random((2000, 2)), np.zeros(2000)])
    others = np.column_stack([0.1 + 0.8 * random.random((300, 2)), np.zeros(300)])
    interpolation = Interpolation.of(plane, np.tile(UP, (2000, 1)), others)
    np.testing.assert_allclose(interpolation(np.ones((2000, 1))), 1)
    np.testing.assert_allclose(interpolation(plane), others, atol=2e-3)


def test_given_normals_choose_the_sheet() -> None:
    points, normals = clouds.sphere(2000)
    both, of_both = np.vstack([points, 0.999 * points]), np.vstack([normals, -normals])
    side = np.repeat([[1.0], [-1.0]], 2000, axis=0)
    others = 0.9995 * points[::5]
    for sign in (1, -1):
        np.testing.assert_allclose(Interpolation.of(both, of_both, others, sign * normals[::5])(side), sign)


def test_normals_that_agree_with_no_neighbour_do_no_harm() -> None:
    points, normals = clouds.sphere(500)
    across = np.roll(normals, 250, axis=0)
    assert np.isfinite(Interpolation.of(points, normals, points, across)(points)).all()
