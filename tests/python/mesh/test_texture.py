# SPDX-License-Identifier: GPL-3.0-or-later
"""A texture shows what the points have, finer than the triangles."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds
from helpers.glb import parts_of, require_validator, validator_messages
from numpy.typing import NDArray

from hdpea import Reconstruction, reconstruct
from hdpea.errors import UsageError
from hdpea.geometry.rasterizing import covered_pixels
from hdpea.geometry.texture import Texture

Array = NDArray[np.float64]
SIZE = 256
POINTS = clouds.sphere_points(6_000)

CLOSE = 25
"""Of 255; the colours of the nearest points are off by 36 at the 95th percentile, those of the vertices by 110."""


def paint(points: Array) -> Array:
    """Return colours (n, 3), from 0 to 1, of stripes as wide as the faces."""
    return 0.5 + 0.4 * np.sin(12 * points)


@pytest.fixture(scope="module")
def painted() -> Reconstruction:
    pytest.importorskip("xatlas")
    return reconstruct(POINTS, POINTS, vertices=150, texture=SIZE, attributes={"colors": paint(POINTS)})


def texture_in(mesh: Reconstruction) -> Texture:
    assert mesh.texture is not None
    return mesh.texture


def looked_up(image: NDArray[np.uint8], places: Array) -> Array:
    """Return the colours, from 0 to 1, at places of an image, bilinear as renderers have them."""
    low = np.floor(SIZE * places - 0.5).astype(int)
    x, y = (SIZE * places - 0.5 - low).T[:, :, None]
    at = lambda i, j: image[(low[:, 1] + j) % SIZE, (low[:, 0] + i) % SIZE] / 255  # noqa: E731
    return (1 - y) * ((1 - x) * at(0, 0) + x * at(1, 0)) + y * ((1 - x) * at(0, 1) + x * at(1, 1))


def samples(mesh: Reconstruction, places: Array, corners: NDArray[np.int64]) -> tuple[Array, Array]:
    """Return points of a mesh, and the places in the image of each."""
    random = np.random.default_rng(1)
    faces = random.integers(0, len(mesh.faces), 4000)
    weights = random.dirichlet([1, 1, 1], 4000)
    blend = lambda values: np.einsum("nk,nkc->nc", weights, values)  # noqa: E731
    return blend(mesh.vertices[mesh.faces[faces]]), blend(places[corners[faces]])


def error_of(image: NDArray[np.uint8], points: Array, places: Array) -> float:
    on_sphere = points / np.linalg.norm(points, axis=1, keepdims=True)
    return float(np.percentile(255 * abs(looked_up(image, places) - paint(on_sphere)).max(axis=1), 95))


def test_detail_finer_than_the_faces_is_in_the_image(painted: Reconstruction) -> None:
    texture = texture_in(painted)
    assert texture.image.shape == (SIZE, SIZE, 3)
    points, places = samples(painted, texture.places, texture.corners)
    assert error_of(texture.image, points, places) < CLOSE
    at_vertices = np.stack([painted.attributes[name] for name in ("red", "green", "blue")], axis=1)[painted.faces]
    means = np.abs(at_vertices.mean(axis=1) / 255 - paint(painted.vertices[painted.faces].mean(axis=1)))
    assert np.percentile(255 * means.max(axis=1), 95) > 50  # which the vertices cannot show


def test_places_belong_to_the_vertices_of_the_faces(painted: Reconstruction) -> None:
    texture = texture_in(painted)
    np.testing.assert_array_equal(texture.vertices[texture.corners], painted.faces)
    assert texture.places.min() >= 0
    assert texture.places.max() <= 1


def test_glb_holds_the_image_and_no_colours_beside_it(painted: Reconstruction, tmp_path: Path) -> None:
    from PIL import Image

    painted.write(tmp_path / "mesh.glb")
    tree, arrays = parts_of(tmp_path / "mesh.glb")
    assert "COLOR_0" not in arrays
    view = tree["bufferViews"][tree["images"][0]["bufferView"]]
    data = (tmp_path / "mesh.glb").read_bytes()
    start = data.index(b"\x89PNG")
    image = np.array(Image.open(io.BytesIO(data[start : start + view["byteLength"]])))
    points, places = samples(painted, arrays["TEXCOORD_0"].astype(float), arrays["indices"].reshape(-1, 3))
    assert error_of(image, points, places) < CLOSE


def test_obj_names_its_files(painted: Reconstruction, tmp_path: Path) -> None:
    from PIL import Image

    painted.write(tmp_path / "mesh.obj")
    text = (tmp_path / "mesh.obj").read_text()
    material = (tmp_path / text.split("mtllib ")[1].split("\n")[0]).read_text()
    image = np.array(Image.open(tmp_path / material.split("map_Kd ")[1].strip()))
    across, up = np.array([line.split()[1:] for line in text.splitlines() if line.startswith("vt ")], float).T
    faces = [line.replace("/", " ").split()[2::2] for line in text.splitlines() if line.startswith("f ")]
    points, places = samples(painted, np.stack([across, 1 - up], axis=1), np.array(faces, int) - 1)
    assert error_of(image, points, places) < CLOSE


def test_the_validator_of_khronos_is_silent(painted: Reconstruction, tmp_path: Path) -> None:
    require_validator()
    painted.write(tmp_path / "mesh.glb")
    assert validator_messages(tmp_path / "mesh.glb") == []


def test_other_formats_hold_none(painted: Reconstruction, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="PLY holds no `texture`"):
        painted.write(tmp_path / "mesh.ply")


def test_points_without_colours_have_no_texture() -> None:
    pytest.importorskip("xatlas")
    with pytest.raises(UsageError, match=r"no colours \(attributes: label\)"):
        reconstruct(POINTS, texture=SIZE, attributes={"label": POINTS[:, 0]})


def test_what_is_missing_is_named_before_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.mesh.texture.find_spec", lambda name: None if name == "xatlas" else name)
    with pytest.raises(UsageError, match="no xatlas") as told:
        reconstruct(POINTS, texture=SIZE, attributes={"colors": POINTS})
    assert "hdpea[texture]" in told.value.hint


def test_every_pixel_belongs_to_one_triangle() -> None:
    square = np.array([[[0, 0], [8, 0], [8, 4]], [[0, 0], [8, 4], [0, 4]]], float)
    found = covered_pixels(square, 4, 8)
    np.testing.assert_array_equal(found.pixels, np.arange(32))
    at = np.einsum("mk,mkc->mc", found.barycentric, square[found.triangles])
    np.testing.assert_allclose(at, np.stack([found.pixels % 8, found.pixels // 8], axis=1) + 0.5)
    assert len(covered_pixels(square[:, [0, 0, 0]], 4, 8).pixels) == 0
    assert len(covered_pixels(square + 100, 4, 8).pixels) == 0
