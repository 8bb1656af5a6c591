# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds

from hdpea import CurvatureTensors, estimate_curvature
from hdpea.curvature.drawing import draw_curvature
from hdpea.curvature.glyphs import UNDETERMINED, glyphs_of
from hdpea.curvature.page import write_page
from hdpea.errors import UsageError
from hdpea.pictures.colors import ratio_colors

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")


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


def test_the_page_needs_nothing_else(tensors: CurvatureTensors, tmp_path: Path) -> None:
    write_page(tmp_path / "glyphs.html", tensors, title="<scan> & co")
    page = (tmp_path / "glyphs.html").read_text()
    assert "{{" not in page
    assert "&lt;scan&gt; &amp; co" in page
    referred = re.findall(r"""\b(?:src|href|url)\s*[=(]\s*["']?([^"'\s)>]+)""", page)
    assert referred == ["data:,"]
    assert "http" not in page
    assert (
        page == (write_page(tmp_path / "again.html", tensors, "<scan> & co"), (tmp_path / "again.html").read_text())[1]
    )


@pytest.mark.slow
def test_a_browser_shows_the_page_without_complaint(tensors: CurvatureTensors, tmp_path: Path) -> None:
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        pytest.skip("there is no Chromium; on Debian: apt-get install chromium")
    from PIL import Image

    page, picture = tmp_path / "glyphs.html", tmp_path / "glyphs.png"
    write_page(page, tensors)
    common = [browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}"]
    common += ["--enable-logging=stderr", "--window-size=800,600"]
    shown = subprocess.run([*common, "--dump-dom", page.as_uri()], capture_output=True, text=True, check=True)
    assert re.search(r'<body data-glyphs="(\d+)"', shown.stdout)
    assert "CONSOLE" not in shown.stderr
    subprocess.run([*common, f"--screenshot={picture}", page.as_uri()], capture_output=True, check=True)
    with Image.open(picture) as image:
        pixels = np.asarray(image.convert("RGB"), dtype=int)
    reddish = pixels[200:, :, 0] - pixels[200:, :, 2]
    assert (reddish > 40).mean() > 0.001
    assert (reddish < -40).mean() > 0.001
