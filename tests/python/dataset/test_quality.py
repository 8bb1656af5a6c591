# SPDX-License-Identifier: GPL-3.0-or-later
"""The quality of embeddings that are known to be perfect, twice too long, flat, or noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from helpers.samples import sphere_sample

from hdpea.dataset.augmentation import augmented, random_rotation
from hdpea.dataset.options import GroundTruthOptions
from hdpea.dataset.quality import isometry_errors, roughness, spacing_of, stretches
from hdpea.dataset.sample import Sample

OPTIONS = GroundTruthOptions()
RADIUS = 12**-0.5
SPACING = (4 * np.pi * RADIUS**2 / OPTIONS.vertices) ** 0.5


def isometric_sphere(times: float = 1.0) -> Sample:
    """Return a sphere that is isometric under the metric times a number: psi is its normal, which stretches it."""
    sample = sphere_sample(4000)
    stretch = times * stretches(sample.curvatures, OPTIONS, SPACING)[0, 0]
    return replace(sample, psi=sample.psi * np.float32(RADIUS * (stretch**2 - 1) ** 0.5))


def test_an_isometric_embedding_has_no_error() -> None:
    assert np.median(isometry_errors(isometric_sphere(), OPTIONS, SPACING)) < 0.01


@pytest.mark.parametrize("times", [2.0, 0.8])
def test_the_error_is_the_ratio_less_one(times: float) -> None:
    errors = isometry_errors(isometric_sphere(times), OPTIONS, SPACING)
    assert np.median(errors) == pytest.approx(abs(times - 1), rel=0.02)


def test_coinciding_points_have_no_error_of_their_own() -> None:
    sample = sphere_sample(20)
    same = replace(sample, surface_points=np.zeros_like(sample.points))
    assert (isometry_errors(same, OPTIONS, SPACING) == 0).all()


def test_the_spacing_is_that_of_the_surface() -> None:
    assert spacing_of(sphere_sample(4000), OPTIONS) == pytest.approx(SPACING, rel=0.02)
    # However uneven the points are: here half of them lie in an eighth of the area.
    sample = sphere_sample(20_000)
    kept = (sample.points > 0).all(axis=1) | (np.arange(20_000) % 7 == 0)
    rows = {name: getattr(sample, name)[kept] for name in ("points", "surface_points", "normals", "psi")}
    thinned = replace(sample, **rows, curvatures=sample.curvatures[kept], direction1=sample.direction1[kept])
    assert spacing_of(thinned, OPTIONS) == pytest.approx(SPACING, rel=0.03)


def test_roughness_tells_flat_from_smooth_from_noise() -> None:
    sample = sphere_sample(4000)
    flat = replace(sample, surface_points=sample.points * np.float32([1, 1, 0]), psi=np.zeros_like(sample.psi))
    upwards = replace(flat, normals=np.tile(np.float32([0, 0, 1]), (4000, 1)))
    assert roughness(upwards).max() < 1e-6
    # A cap of 13 points of 4,000 on a sphere: as high as wide by a quarter of its opening.
    assert 0 < np.median(roughness(isometric_sphere())) < 0.03
    noise = np.random.default_rng(0).normal(size=(4000, 5)).astype(np.float32)
    assert np.median(roughness(replace(sample, psi=noise))) > 0.5


def test_quality_does_not_change_when_turned() -> None:
    sample = isometric_sphere(1.1)
    turned = augmented(sample, random_rotation(3))
    np.testing.assert_allclose(roughness(turned), roughness(sample), atol=1e-4)
    errors = (isometry_errors(each, OPTIONS, SPACING) for each in (turned, sample))
    np.testing.assert_allclose(*errors, atol=1e-3)
