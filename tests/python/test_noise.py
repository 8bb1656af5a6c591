# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from collections.abc import Callable

import clouds
import numpy as np
import pytest

from hdpea.noise import noise_in_spacings


@pytest.mark.parametrize("share", [0.1, 0.5])
def test_noise_is_told_in_spacings(share: float) -> None:
    random = np.random.default_rng(0)
    spacing = 4_000**-0.5
    rough = np.column_stack([random.random((4_000, 2)), random.normal(0, share * spacing, 4_000)])
    told = noise_in_spacings(rough)
    # The lower quartile over points is somewhat below their median.
    assert 0.75 * share < told < 1.1 * share
    assert noise_in_spacings(1000 * rough + 1e5) == pytest.approx(told, rel=1e-6)


@pytest.mark.parametrize("cloud", [clouds.plane, clouds.torus, clouds.ellipsoid, clouds.box])
def test_neither_curvature_nor_creases_are_noise(cloud: Callable[[int], clouds.Cloud]) -> None:
    assert noise_in_spacings(cloud(4_000)[0]) < 0.01


def test_points_too_few_or_on_a_line_have_none() -> None:
    assert noise_in_spacings(clouds.sphere(20)[0]) == 0
    assert noise_in_spacings(np.outer(np.linspace(0, 1, 100), [1.0, 2, 3])) == pytest.approx(0, abs=1e-9)
