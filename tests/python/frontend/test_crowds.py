# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np
import pytest

from hdpea import reconstruct
from hdpea.frontend.cleaning import surface_cloud
from hdpea.frontend.crowds import crowd_means
from hdpea.reading.cleaning import cleaned_cloud


def _seen_ten_times(noise: float) -> np.ndarray:
    """Return a unit sphere of 2,000 places, each seen ten times with noise along the ray, in spacings."""
    count = 2000
    polar = np.arccos(1 - 2 * (np.arange(count) + 0.5) / count)
    turned = np.arange(count) * np.pi * (1 + 5**0.5)
    places = np.stack([np.sin(polar) * np.cos(turned), np.sin(polar) * np.sin(turned), np.cos(polar)], axis=1)
    spacing = np.sqrt(4 * np.pi / count)
    random = np.random.default_rng(0)
    return np.vstack([places * (1 + random.normal(0, noise * spacing, (count, 1))) for _ in range(10)])


def test_the_mean_is_of_the_points_stood_for_and_of_no_strays():
    points = np.array([[0.0, 0, 0], [1, 0, 0], [10, 0, 0], [0, 9, 0]])
    means = crowd_means(points, np.array([True, False, True, False]), np.array([0, 0, 2, 3]))
    np.testing.assert_allclose(means, [[0.5, 0, 0], [10, 0, 0]])


def test_repeated_scans_have_less_noise_than_one():
    left = surface_cloud(cleaned_cloud(_seen_ten_times(0.1), None, None)).cloud.points
    one = _seen_ten_times(0.1)[:2000]
    noise, of_one = (abs(np.linalg.norm(each, axis=1) - 1).mean() for each in (left, one))
    assert noise < 0.6 * of_one


@pytest.mark.parametrize("noise", [0.02, 0.1, 0.3])
def test_a_sphere_seen_ten_times_comes_out_closed(noise):
    mesh = reconstruct(_seen_ten_times(noise))
    assert mesh.report.mesh.closed
    assert (mesh.report.mesh.components, mesh.report.mesh.genus) == (1, 0)
    corners = mesh.vertices[mesh.faces]
    volume = np.linalg.det(corners).sum() / 6
    assert volume == pytest.approx(4 * np.pi / 3, rel=0.02)
