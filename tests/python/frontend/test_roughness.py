# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from helpers import clouds
from helpers.raw_clouds import noise_by_range

from hdpea.frontend.roughness import Roughness, roughness_of


@pytest.mark.parametrize("share", [0.1, 0.5, 1, 1.5])
def test_noise_is_told_in_spacings(share: float) -> None:
    random = np.random.default_rng(0)
    spacing = 4_000**-0.5
    rough = np.column_stack([random.random((4_000, 2)), random.normal(0, share * spacing, 4_000)])
    told = roughness_of(rough)
    # The lower quartile over points is somewhat below their median.
    assert 0.75 * share < told.noise < 1.1 * share
    assert roughness_of(1000 * rough + 1e5).noise == pytest.approx(told.noise, rel=1e-6)


@pytest.mark.parametrize("cloud", [clouds.plane, clouds.torus, clouds.ellipsoid, clouds.box])
def test_neither_curvature_nor_creases_are_noise(cloud: Callable[[int], clouds.Cloud]) -> None:
    assert roughness_of(cloud(4_000)[0]).deviation < 0.01


@pytest.mark.parametrize("spacings_apart", [0.5, 1, 2])
def test_the_two_sides_of_a_thin_wall_are_not_noise(spacings_apart: float) -> None:
    wall = clouds.two_sheets(4_000, spacings_apart=spacings_apart, facing=-1)[0]
    told = roughness_of(wall)
    assert told.deviation > 0.1
    assert told.noise == 0


def test_points_too_few_or_on_a_line_have_none() -> None:
    assert roughness_of(clouds.sphere(20)[0]) == Roughness(0, False)
    assert roughness_of(np.outer(np.linspace(0, 1, 100), [1.0, 2, 3])).deviation == pytest.approx(0, abs=1e-9)


def test_points_that_coincide_are_smooth() -> None:
    points = np.repeat(clouds.sphere(40)[0], 40, axis=0)
    assert roughness_of(points).deviation < 1e-6


@pytest.mark.parametrize("noise_along", [lambda x: 0.1 + 0.7 * x, lambda x: x**2], ids=["from some", "from none"])
def test_of_noise_that_differs_that_of_the_roughest_regions_is_told(
    noise_along: Callable[[clouds.Array], clouds.Array],
) -> None:
    random = np.random.default_rng(0)
    points, spacing = random.random((10_000, 3)) * [1, 1, 0], 10_000**-0.5
    share = noise_along(points[:, 0])
    points[:, 2] = spacing * share * random.normal(size=10_000)
    assert 0.45 < roughness_of(points).noise < 0.8


def test_so_it_is_where_these_are_rougher_than_the_residuals_tell() -> None:
    points = clouds.sphere(10_000)[0]
    # A quarter of the points has less than 0.7 spacings, a quarter more than 1.6.
    assert roughness_of(noise_by_range(points, 0.1, 2)).noise > 1.2
    # Even noise, where regions differ by chance, is no more than it is.
    assert roughness_of(noise_by_range(points, 1, 1)).noise == pytest.approx(1, rel=0.15)
