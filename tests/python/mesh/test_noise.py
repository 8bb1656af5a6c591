# SPDX-License-Identifier: GPL-3.0-or-later
"""A number of vertices that nobody asks for is no larger than noise allows."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea import Reconstruction, reconstruct
from hdpea.geometry.sampling import sample_surface
from hdpea.mesh.noise import error_within_noise, within_noise
from hdpea.options import DenoisingOptions, Length, MeshingOptions, Options
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.surface.preparation import prepare_surface

POINTS = 5000


def wanted(points: clouds.Array, options: Options | None = None) -> int:
    prepared = prepare_surface(cleaned_cloud(points), denoising=DenoisingOptions())
    return within_noise(options or Options(), prepared, len(points))[0].vertices_of(len(points))


def wall(deviation: float) -> clouds.Array:
    """Return a flat square with noise of so many spacings."""
    random = np.random.default_rng(0)
    return np.column_stack([random.random((POINTS, 2)), deviation / np.sqrt(POINTS) * random.normal(size=POINTS)])


def noisy_sphere(deviation: float) -> clouds.Array:
    noise = np.random.default_rng(0).normal(scale=deviation * np.sqrt(4 * np.pi / POINTS), size=(POINTS, 1))
    return (1 + noise) * clouds.sphere(POINTS)[0]


def test_a_noisy_wall_gets_few_vertices_and_a_clean_one_what_its_points_allow() -> None:
    assert wanted(wall(0.0)) == POINTS // 8
    assert wanted(wall(0.4)) <= POINTS // 64


def test_a_little_noise_changes_nothing() -> None:
    assert wanted(noisy_sphere(0.1)) == POINTS // 8


def test_what_is_asked_for_is_made_whatever_the_noise() -> None:
    assert wanted(wall(0.4), Options(meshing=MeshingOptions(vertices=400))) == 400


def error_of(mesh: Reconstruction) -> float:
    """Return how far the faces of a mesh are off the unit sphere, root mean square."""
    samples = sample_surface(mesh.vertices, mesh.faces, 5000).points
    return float(np.sqrt(np.square(np.linalg.norm(samples, axis=1) - 1).mean()))


def test_a_noisy_sphere_is_as_near_to_the_truth_with_the_fewer_vertices() -> None:
    points = noisy_sphere(0.7)
    few, many = reconstruct(points), reconstruct(points, vertices=POINTS // 8)
    assert len(few.vertices) < 0.6 * len(many.vertices)
    assert any(choice.name == "vertices" for choice in few.report.choices)
    assert error_of(few) <= 1.05 * error_of(many)


@pytest.mark.parametrize(("deviations", "told"), [(2.0, True), (4.0, False)])
def test_an_error_within_the_noise_is_told(deviations: float, told: bool) -> None:
    noise = 0.15  # in spacings, so little that nothing is denoised
    prepared = prepare_surface(cleaned_cloud(wall(noise)), denoising=DenoisingOptions())
    options = Options(meshing=MeshingOptions(error=Length(deviations * noise / np.sqrt(POINTS))))
    assert bool(error_within_noise(options, prepared)) == told
    assert not error_within_noise(Options(), prepared)
