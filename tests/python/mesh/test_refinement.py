# SPDX-License-Identifier: GPL-3.0-or-later
"""Refinement moves vertices, and nothing but vertices, towards the points."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from helpers import clouds
from helpers.reconstructions import VERTICES, cloud_of, mesh_of, options

from hdpea import reconstruct
from hdpea.errors import Interrupted
from hdpea.options import Options, ParticleOptions
from hdpea.options.cleaning import CleaningOptions


def rms(shape: str, refine: bool) -> float:
    distances = mesh_of(shape, refine=refine).report.distances
    assert distances is not None
    return distances.rms


@pytest.mark.parametrize("shape", [*clouds.CLOSED, "cylinder"])
def test_the_points_come_closer(shape: str) -> None:
    before = rms(shape, refine=False)
    # Where creases are aligned, a mesh of flat sides may be exact before any fit: to the last digits then.
    assert rms(shape, refine=True) < max(0.8 * before, 1e-12)


@pytest.mark.parametrize("shape", ["cube", "plate"])
def test_flat_sides_are_met_exactly(shape: str) -> None:
    distances = mesh_of(shape).report.distances
    assert distances is not None
    assert distances.rms < 1e-3 * distances.spacing


@pytest.mark.parametrize(("size", "seed"), [((1, 1, 1), 4), ((1, 1, 0.1), 0)])
def test_corners_stay_and_creases_with_gaps_are_followed(size: tuple[float, float, float], seed: int) -> None:
    # A vertex that slid off a corner cut it off by three quarters of a spacing.
    distances = reconstruct(*clouds.box(4000, size, seed), options()).report.distances
    assert distances is not None
    assert distances.max < 1e-3 * distances.spacing


@pytest.mark.parametrize("shape", ["torus", "cube", "cylinder"])
def test_the_faces_stay_as_they_are(shape: str) -> None:
    # Without remeshing between two fits, which goes by where the first one leaves the vertices.
    few = ParticleOptions(particles=VERTICES)
    fitted, not_fitted = (
        reconstruct(*cloud_of(shape), replace(options(refine=refine), particles=few)) for refine in (True, False)
    )
    np.testing.assert_array_equal(fitted.faces, not_fitted.faces)


@pytest.mark.parametrize("shape", ["sphere", "torus", "ellipsoid"])
def test_a_smooth_surface_is_met_within_a_tenth_of_the_spacing(shape: str) -> None:
    distances = mesh_of(shape).report.distances
    assert distances is not None
    assert distances.rms < 0.1 * distances.spacing
    assert distances.max < distances.spacing


def test_it_can_be_interrupted() -> None:
    with pytest.raises(Interrupted):
        reconstruct(*cloud_of("sphere", 500), options(60), lambda phase, _: phase != "refinement")


def test_points_of_a_piece_that_is_dropped_draw_no_spike() -> None:
    points, normals = clouds.sphere(4000)
    patch = np.array([[x, y, 1.6] for x in range(5) for y in range(5)]) * [0.05, 0.05, 1]
    everything = np.vstack([points, patch]), np.vstack([normals, np.tile([0.0, 0.0, 1.0], (25, 1))])
    made = reconstruct(*everything, replace(Options(), cleaning=CleaningOptions(outliers="none")))
    assert made.report.meshing["dropped_components"] == 1
    assert np.linalg.norm(made.vertices, axis=1).max() < 1.05
