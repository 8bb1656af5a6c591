# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.pictures import picture
from hdpea.pictures.picture import Camera, check_drawing, draw_mesh, draw_points

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def box(size: tuple[float, float, float]) -> Mesh:
    mesh = trimesh.creation.box(size)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


def drawn(path: Path, mesh: Mesh, points: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
    draw_mesh(path, *mesh, points, size=(200, 150))
    from PIL import Image

    with Image.open(path) as image:
        return np.asarray(image.convert("L"), dtype=float)


@pytest.mark.slow
def test_the_shape_fills_the_middle_of_the_picture(tmp_path: Path) -> None:
    pixels = drawn(tmp_path / "box.png", box((1, 1, 1)))
    assert pixels.shape == (150, 200)
    assert pixels[75, 100] < 250
    assert (pixels[[0, 0, -1, -1], [0, -1, 0, -1]] == 255).all()
    rows = np.flatnonzero((pixels < 250).any(axis=1))
    assert rows[0] + rows[-1] == pytest.approx(150, abs=4)
    assert np.ptp(rows) > 0.9 * 150


@pytest.mark.slow
def test_georeferenced_coordinates_give_the_same_picture(tmp_path: Path) -> None:
    vertices, faces = box((1, 2, 3))
    near, far = (drawn(tmp_path / "box.png", (vertices + shift, faces)) for shift in (0, 1e7))
    assert abs(near - far).mean() < 1


@pytest.mark.slow
def test_points_are_drawn_over_the_mesh(tmp_path: Path) -> None:
    mesh = box((1, 1, 1))
    bare, dotted = (drawn(tmp_path / "box.png", mesh, points) for points in (None, 1.02 * mesh[0]))
    assert (bare != dotted).any()


@pytest.mark.slow
def test_points_are_drawn_in_their_colours_where_a_mesh_of_them_would_be(tmp_path: Path) -> None:
    vertices, faces = box((1, 1, 1))
    camera = Camera.before(vertices, faces)
    shown = np.random.default_rng(0).random((20_000, 3)) - 0.5
    draw_points(tmp_path / "points.png", shown, np.tile(np.uint8([[10, 200, 30]]), (20_000, 1)), (200, 150), camera)
    draw_mesh(tmp_path / "mesh.png", vertices, faces, size=(200, 150), camera=camera)
    from PIL import Image

    points, mesh = (
        np.asarray(Image.open(tmp_path / name).convert("RGB"), float) for name in ("points.png", "mesh.png")
    )
    covered = [(pixels < 250).any(axis=2) for pixels in (points, mesh)]
    assert (covered[0] & covered[1]).sum() > 0.85 * (covered[0] | covered[1]).sum()
    np.testing.assert_allclose(points[75, 100], [10, 200, 30], atol=2)


def test_missing_pyvista_says_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "find_spec", lambda _: None)
    with pytest.raises(UsageError, match="pyvista") as caught:
        check_drawing()
    assert "hdpea[picture]" in caught.value.hint


def test_neither_screen_nor_osmesa_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture, "find_library", lambda _: None)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setattr("sys.platform", "linux")
    with pytest.raises(UsageError, match="screen") as caught:
        check_drawing()
    assert "libosmesa6" in caught.value.hint


def test_other_formats_than_png_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="extension"):
        draw_mesh(tmp_path / "mesh.pdf", *box((1, 1, 1)))


@pytest.mark.slow
def test_meshes_before_one_camera_keep_their_sizes_and_colours(tmp_path: Path) -> None:
    large, small = box((2, 2, 2)), box((1, 1, 1))
    red = np.tile(np.array([[200, 20, 20]], np.uint8), (len(small[0]), 1))
    camera = Camera.before(*large)
    draw_mesh(tmp_path / "large.png", *large, size=(200, 150), camera=camera)
    draw_mesh(tmp_path / "small.png", *small, size=(200, 150), camera=camera, colors=red)
    from PIL import Image

    drawn_pixels = []
    for name in ("large.png", "small.png"):
        with Image.open(tmp_path / name) as image:
            drawn_pixels.append(np.asarray(image.convert("RGB"), dtype=float))
    areas = [(pixels < 250).any(axis=2).sum() for pixels in drawn_pixels]
    assert areas[0] / areas[1] == pytest.approx(4, rel=0.05)
    middle = drawn_pixels[1][75, 100]
    assert middle[0] > 3 * middle[1:].max()
