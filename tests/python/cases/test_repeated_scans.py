# SPDX-License-Identifier: GPL-3.0-or-later
"""The same places seen again and again: no worse than seen once."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds
from helpers.raw_clouds import jittered_copies, noise_by_range, repeated_rays
from helpers.raw_meshes import assert_ball

from hdpea import reconstruct
from hdpea.frontend.classifying import classify


@pytest.mark.parametrize(("frames", "noise"), [(2, 0.02), (3, 0.1)])
def test_rays_seen_repeatedly_give_the_ball(frames: int, noise: float) -> None:
    assert_ball(reconstruct(repeated_rays(1200, frames, noise)))


def test_so_do_rays_at_random_with_noise_as_wide_as_some_are_apart() -> None:
    assert_ball(reconstruct(repeated_rays(3000, 10, 0.3, at_random=True)))


@pytest.mark.parametrize("copies", [14, 20, 28])
def test_of_copies_one_is_kept_however_many_there_are(copies: int) -> None:
    assert classify(jittered_copies(2000, copies, 1e-6)).kept.sum() == 2000


def test_it_does_not_matter_how_often_copies_are_rounded_differently() -> None:
    kept = [classify(jittered_copies(2000, copies, 1e-6)).kept.sum() for copies in (2, 3, 8)]
    assert kept == [2000, 2000, 2000]


def test_each_place_of_a_small_cloud_is_kept_once() -> None:
    copies = jittered_copies(600, 8, 1e-5)
    found = classify(copies)
    assert found.kept.sum() == 600
    assert set(np.flatnonzero(found.kept) % 600) == set(range(600))
    assert_ball(reconstruct(copies))


@pytest.mark.parametrize(("frames", "noise"), [(3, 0.02), (10, 0.02), (10, 0.1)])
def test_of_rays_that_are_told_apart_about_one_is_kept(frames: int, noise: float) -> None:
    assert classify(repeated_rays(2000, frames, noise)).kept.sum() == pytest.approx(2000, rel=0.05)


@pytest.mark.parametrize("cloud", ["sphere", "torus", "cube"])
def test_points_spread_at_random_are_no_copies(cloud: str) -> None:
    assert classify(clouds.CLOSED[cloud](4000)[0]).kept.mean() > 0.999


def test_noise_that_grows_with_the_range_is_told_where_it_is_wide() -> None:
    points = clouds.sphere(10_000)[0]
    sight = points - [4.0, 0, 0.5]
    ranges = np.linalg.norm(sight, axis=1, keepdims=True)
    noise = 0.0015 * ranges**2 * np.random.default_rng(1).normal(size=ranges.shape)
    made = reconstruct(points + sight / ranges * noise)
    assert made.report.mesh.self_intersections == 0
    assert not made.report.missed
    off = abs(np.linalg.norm(made.vertices[made.faces].mean(axis=1), axis=1) - 1)
    # A fifth of the noise at the far side.
    assert np.sqrt(np.square(off).mean()) < 0.2 * 0.0015 * 5**2


def test_noise_that_grows_to_two_spacings_leaves_one_closed_ball() -> None:
    assert_ball(reconstruct(noise_by_range(clouds.sphere_points(8000), 0.1, 2)))
