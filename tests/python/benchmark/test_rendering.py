# SPDX-License-Identifier: GPL-3.0-or-later
"""PSNR and SSIM, against closed forms and by how they order surfaces."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from hdpea.benchmark.rendering import LEAST_ERROR, SIZE, compare_renderings, render, structural_similarity
from hdpea.errors import UsageError
from hdpea.geometry.triangles import TriangleMesh
from hdpea.pictures.picture import Camera, check_drawing


def ball(subdivisions: int) -> TriangleMesh:
    mesh = trimesh.creation.icosphere(subdivisions)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces, np.int64)


@pytest.fixture
def _drawing() -> None:
    try:
        check_drawing()
    except UsageError as error:
        pytest.skip(error.message)


def test_ssim_of_equal_pictures_is_one() -> None:
    picture = np.random.default_rng(0).random((20, 30))
    likeness = structural_similarity(picture, picture)
    assert likeness.shape == (10, 20)
    np.testing.assert_allclose(likeness, 1)


def test_ssim_of_even_pictures_is_that_of_their_brightness() -> None:
    one, other = np.full((12, 12), 0.4), np.full((12, 12), 0.8)
    expected = (2 * 0.4 * 0.8 + 0.01**2) / (0.4**2 + 0.8**2 + 0.01**2)  # Wang et al. (2004), equation 6
    np.testing.assert_allclose(structural_similarity(one, other), expected)


def test_ssim_of_a_negative_is_negative_and_symmetric() -> None:
    picture = np.random.default_rng(0).random((30, 30))
    likeness = structural_similarity(picture, 1 - picture)
    assert likeness.max() < 0
    np.testing.assert_allclose(likeness, structural_similarity(1 - picture, picture))


@pytest.mark.slow
@pytest.mark.usefixtures("_drawing")
def test_rougher_balls_look_less_like_a_ball() -> None:
    truth = ball(5)
    same, fine, coarse = (compare_renderings(truth, ball(n)) for n in (5, 3, 2))
    assert same == {"psnr": -10 * np.log10(LEAST_ERROR), "ssim": pytest.approx(1)}
    assert same["psnr"] > fine["psnr"] > coarse["psnr"] > 10
    assert 1 > fine["ssim"] > coarse["ssim"] > 0


@pytest.mark.slow
@pytest.mark.usefixtures("_drawing")
def test_pictures_are_of_the_mesh_on_white() -> None:
    mesh = ball(4)
    picture = render(mesh, Camera.before(*mesh))
    assert picture.shape == SIZE[::-1]
    assert picture[0, 0] == 1
    covered = (picture < 0.99).mean()
    assert covered == pytest.approx(np.pi / 4 / 1.04**2, rel=0.02)  # of the square with a margin
