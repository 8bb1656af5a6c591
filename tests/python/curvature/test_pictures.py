# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from helpers import clouds
from helpers.browser import Browser

from hdpea import CurvatureTensors, estimate_curvature
from hdpea.curvature.drawing import draw_curvature
from hdpea.curvature.glyphs import UNDETERMINED, glyphs_of
from hdpea.curvature.page import write_page
from hdpea.errors import UsageError
from hdpea.pictures.colors import ratio_colors


@pytest.fixture(scope="module")
def tensors() -> CurvatureTensors:
    return estimate_curvature(*clouds.ellipsoid(2_000))


def test_glyphs_are_long_along_the_smaller_curvature(tensors: CurvatureTensors) -> None:
    glyphs = glyphs_of(tensors, 500)
    lengths = np.linalg.norm(glyphs.axes, axis=2)
    assert lengths.shape == (500, 3)
    assert glyphs.most >= 1.5
    assert (lengths[:, 0] <= lengths[:, 1] * (1 + 1e-9)).all()
    np.testing.assert_allclose(lengths[:, 0] * lengths[:, 1], glyphs.radius**2)
    corner = glyphs.axes / lengths[:, :, None]
    np.testing.assert_allclose(corner @ corner.swapaxes(1, 2), np.tile(np.eye(3), (500, 1, 1)), atol=1e-9)
    np.testing.assert_allclose(corner[:, 2], glyphs.normals, atol=1e-9)


def test_there_are_no_more_glyphs_than_points(tensors: CurvatureTensors) -> None:
    assert len(glyphs_of(tensors, 10_000).centres) == 2_000


def test_glyphs_without_directions_are_round_and_grey() -> None:
    glyphs = glyphs_of(estimate_curvature(clouds.sphere(2_000)[0]), 100)
    lengths = np.linalg.norm(glyphs.axes, axis=2)
    grey = (glyphs.colors == np.rint(255 * np.array(UNDETERMINED))).all(axis=1)
    assert grey.mean() > 0.9
    np.testing.assert_allclose(lengths[grey, 0], lengths[grey, 1])


def test_colors_run_from_blue_over_grey_to_red() -> None:
    one, two, four, more = ratio_colors(np.array([1.0, 2, 4, 100])).tolist()
    assert one[2] > one[0]
    assert two[0] == two[1] == two[2]
    assert four[0] > four[2]
    assert more == four


@pytest.mark.slow
def test_the_picture_shows_colored_glyphs(tensors: CurvatureTensors, tmp_path: Path) -> None:
    from PIL import Image

    draw_curvature(tmp_path / "glyphs.png", tensors, size=(200, 150))
    with Image.open(tmp_path / "glyphs.png") as image:
        pixels = np.asarray(image.convert("RGB"), dtype=int)
    assert pixels.shape == (150, 200, 3)
    assert (pixels[0, 0] == 255).all()
    reddish = pixels[:, :, 0] - pixels[:, :, 2]
    assert (reddish > 40).any()
    assert (reddish < -40).any()


def test_other_formats_are_refused(tensors: CurvatureTensors, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="extension"):
        draw_curvature(tmp_path / "glyphs.pdf", tensors)
    with pytest.raises(UsageError, match="extension"):
        write_page(tmp_path / "glyphs.pdf", tensors)


def test_the_page_shows_tensors_and_points(tensors: CurvatureTensors, tmp_path: Path) -> None:
    write_page(tmp_path / "glyphs.html", tensors, title="<scan> & co")
    page = (tmp_path / "glyphs.html").read_text()
    assert "&lt;scan&gt; &amp; co" in page
    for name in ("tensors", "points", "stretching ratio", "curvature 1", "curvature 2"):
        assert f'"name":"{name}"' in page


@pytest.mark.slow
def test_a_browser_shows_the_page_without_complaint(tensors: CurvatureTensors, tmp_path: Path) -> None:
    browser, page = Browser(tmp_path), tmp_path / "glyphs.html"
    write_page(page, tensors)
    triangles, points = browser.drawn(page)
    assert triangles > 2_000 * 12
    assert points == 0
    pixels = browser.picture(page)
    reddish = pixels[200:, :, 0] - pixels[200:, :, 2]
    assert (reddish > 40).mean() > 0.001
    assert (reddish < -40).mean() > 0.001
