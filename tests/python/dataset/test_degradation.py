# SPDX-License-Identifier: GPL-3.0-or-later
"""Degradation: what is asked for and nothing else; the truth stays true."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from helpers import meshes
from helpers.samples import numbered_sample

from hdpea.dataset.degradation import STRIPES, degraded, with_normal_noise
from hdpea.dataset.options import DegradationOptions
from hdpea.dataset.sample import Sample
from hdpea.errors import UsageError

ORIGINAL = numbered_sample(meshes.box(), 5000)
TRUTH = ("surface_points", "normals", "psi", "curvatures", "direction1")
REMOVING: list[dict[str, Any]] = [{"clipped": True}, {"missing": 5}, {"density": "gradient"}, {"density": "striped"}]
MOVING: list[dict[str, Any]] = [{"noise": 0.005}, {"outliers": 0.05}]
NORMALS: list[dict[str, Any]] = [{"normal_noise": 0.1}, {"flipped": 0.3}]
ALL = {"clipped": True, "missing": 2, "density": "striped", "noise": 0.003, "outliers": 0.02} | NORMALS[0] | NORMALS[1]


def worse(sample: Sample = ORIGINAL, **options: Any) -> Sample:
    return degraded(sample, DegradationOptions(**options))


def rows(sample: Sample) -> Any:
    """Return which rows of the original the truth of each point is: its first psi counts them."""
    return sample.psi[:, 0].astype(int)


def assert_equal(one: Sample, other: Sample) -> None:
    for each in fields(Sample):
        np.testing.assert_array_equal(getattr(one, each.name), getattr(other, each.name))


def test_by_default_nothing_happens() -> None:
    assert worse() is ORIGINAL


@pytest.mark.parametrize("options", [*REMOVING, *MOVING, *NORMALS, ALL])
def test_truth_stays_true_row_by_row(options: dict[str, Any]) -> None:
    sample = worse(**options)
    for name in TRUTH:
        np.testing.assert_array_equal(getattr(sample, name), getattr(ORIGINAL, name)[rows(sample)])
    assert {getattr(sample, each.name).dtype for each in fields(sample) if each.name in TRUTH} == {np.dtype("f4")}
    assert sample.points.dtype == np.float32
    assert sample.sensors is not None
    assert sample.sensors.shape == sample.points.shape


@pytest.mark.parametrize("options", REMOVING)
def test_removing_keeps_the_points_that_stay_in_order(options: dict[str, Any]) -> None:
    sample = worse(**options)
    assert 0 < len(sample.points) < len(ORIGINAL.points)
    assert (np.diff(rows(sample)) > 0).all()
    np.testing.assert_array_equal(sample.points, ORIGINAL.points[rows(sample)])


@pytest.mark.parametrize("options", REMOVING + MOVING)
def test_other_points_have_no_normals_estimated_yet(options: dict[str, Any]) -> None:
    assert worse(replace(ORIGINAL, estimated_normals=ORIGINAL.normals), **options).estimated_normals is None


@pytest.mark.parametrize("std", [0.001, 0.003, 0.005])
def test_noise_has_its_std_and_moves_the_points_only(std: float) -> None:
    sample = worse(noise=std)
    np.testing.assert_allclose((sample.points - ORIGINAL.points).std(axis=0), std, rtol=0.05)
    assert_equal(replace(sample, points=ORIGINAL.points), ORIGINAL)


@pytest.mark.parametrize("std", [0.001, 0.002])
def test_normal_noise_tilts_what_a_method_is_given_and_not_the_truth(std: float) -> None:
    given = worse(normal_noise=std).estimated_normals
    assert given is not None
    np.testing.assert_allclose(np.linalg.norm(given, axis=1), 1, atol=1e-6)
    tilt = np.linalg.norm(given - ORIGINAL.normals, axis=1)
    assert np.sqrt((tilt**2).mean()) == pytest.approx(2**0.5 * std, rel=0.05)  # what is along the normal is lost


def test_normal_noise_is_on_the_estimated_normals_where_there_are_any() -> None:
    sample = replace(ORIGINAL, estimated_normals=-ORIGINAL.normals)
    given = with_normal_noise(sample, 0.001, np.random.default_rng(0)).estimated_normals
    assert given is not None
    assert ((given * ORIGINAL.normals).sum(axis=1) < -0.99).all()


def test_flipped_normals_are_turned_round_and_the_truth_stays() -> None:
    given = worse(flipped=0.3).estimated_normals
    assert given is not None
    agreement = (given * ORIGINAL.normals).sum(axis=1)
    np.testing.assert_allclose(abs(agreement), 1, atol=1e-6)
    assert (agreement < 0).mean() == pytest.approx(0.3, abs=1e-3)


def test_half_of_the_directions_are_clipped() -> None:
    for seed in range(5):
        assert 0.3 < len(worse(clipped=True, seed=seed).points) / len(ORIGINAL.points) < 0.7


def test_missing_balls_leave_nothing_within() -> None:
    sample = worse(missing=1, missing_radius=0.2)
    gone = np.setdiff1d(np.arange(len(ORIGINAL.points)), rows(sample))
    assert np.ptp(ORIGINAL.points[gone], axis=0).max() <= 0.4
    to_gone = np.linalg.norm(sample.points[:, None] - ORIGINAL.points[gone].mean(axis=0), axis=-1)
    assert to_gone.min() > 0.1


def test_a_gradient_falls_along_the_longest_axis_only() -> None:
    sample = worse(density="gradient")
    shares = [
        np.histogram(sample.points[:, axis], 4)[0] / np.histogram(ORIGINAL.points[:, axis], 4)[0] for axis in (0, 1)
    ]
    np.testing.assert_allclose(shares[0], [0.89, 0.66, 0.44, 0.21], atol=0.07)
    np.testing.assert_allclose(shares[1], 0.55, atol=0.07)


def test_stripes_are_dense_and_sparse_in_turn() -> None:
    shares = (
        np.histogram(worse(density="striped").points[:, 0], STRIPES)[0]
        / np.histogram(ORIGINAL.points[:, 0], STRIPES)[0]
    )
    np.testing.assert_allclose(shares[::2], 1, atol=0.02)
    np.testing.assert_allclose(shares[1::2], 0.1, atol=0.07)


def test_outliers_are_as_many_as_asked_for_and_stand_for_the_nearest_point() -> None:
    sample = worse(outliers=0.05)
    strayed = np.flatnonzero((sample.points != ORIGINAL.points).any(axis=1))
    assert len(strayed) == 250
    distances = np.linalg.norm(sample.points[strayed, None] - ORIGINAL.surface_points, axis=-1)
    np.testing.assert_array_equal(distances.argmin(axis=1), rows(sample)[strayed])
    assert abs(sample.points).max() > abs(ORIGINAL.points).max()
    np.testing.assert_array_equal(sample.sensors, ORIGINAL.sensors)


def test_everything_together_by_the_seed() -> None:
    assert_equal(worse(**ALL, seed=1), worse(**ALL, seed=1))
    assert len(worse(**ALL, seed=1).points) != len(worse(**ALL, seed=2).points)


def test_one_degradation_does_not_change_what_another_draws() -> None:
    alone, both = worse(clipped=True), worse(clipped=True, noise=0.001)
    np.testing.assert_array_equal(alone.surface_points, both.surface_points)


def test_removing_everything_is_refused() -> None:
    with pytest.raises(UsageError, match="leaves no points"):
        worse(missing=1, missing_radius=2.0)
