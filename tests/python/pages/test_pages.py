# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import json
import re
from base64 import b64decode
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from helpers import clouds, meshes
from helpers.browser import Browser
from numpy.typing import NDArray

from hdpea.cli import run
from hdpea.errors import UsageError
from hdpea.geometry.tensors import frames
from hdpea.pages.colorings import DISTANCE, mesh_shape, point_shape
from hdpea.pages.encoding import STEPS, UNKNOWN, encoded_coloring
from hdpea.pages.page import write_page
from hdpea.pages.shapes import Coloring, EllipsoidShape, OwnColors, Shape
from hdpea.writing.meshes import write_mesh


def sphere_with_points(shift: float = 0.0) -> list[Shape]:
    vertices, faces = meshes.icosphere()
    vertices, points = vertices + shift, clouds.sphere(2_000)[0] / 2 + shift
    return [mesh_shape("mesh", vertices, faces, points), point_shape("points", points, (vertices, faces))]


def test_a_cloud_and_its_mesh_stand_upright_in_either_order(tmp_path: Path) -> None:
    shapes = sphere_with_points()
    stretched = [replace(shapes[0], vertices=shapes[0].vertices * [1, 3, 1]), shapes[1]]
    for name, order in ("there.html", stretched), ("back.html", stretched[::-1]):
        write_page(tmp_path / name, "page", order)
    there, back = scene_of(tmp_path / "there.html"), scene_of(tmp_path / "back.html")
    assert (there["up"], there["eye"]) == (back["up"], back["eye"])


def scene_of(page: Path) -> dict[str, Any]:
    found = re.search(r"^const page = (.*);$", page.read_text(), re.MULTILINE)
    assert found
    scene: dict[str, Any] = json.loads(found[1])
    return scene


def test_a_page_holds_the_mesh_to_within_a_step(tmp_path: Path) -> None:
    shapes = sphere_with_points(shift=1e6)
    write_page(tmp_path / "page.html", "sphere", shapes)
    scene = scene_of(tmp_path / "page.html")
    mesh = scene["shapes"][0]
    steps = np.frombuffer(b64decode(mesh["positions"]), "<u2").reshape(-1, 3)
    positions = np.array(scene["origin"]) + np.array(scene["extent"]) * steps / STEPS
    everything = np.vstack([shapes[0].vertices, shapes[1].points])  # type: ignore[union-attr]
    low, size = everything.min(axis=0), np.ptp(everything, axis=0).max()
    middle = low + np.ptp(everything, axis=0) / 2
    np.testing.assert_allclose(positions * size + middle, shapes[0].vertices, atol=size / STEPS)  # type: ignore[union-attr]
    faces = np.frombuffer(b64decode(mesh["faces"]), "<u2").reshape(-1, 3)
    np.testing.assert_array_equal(faces, shapes[0].faces)  # type: ignore[union-attr]


def test_a_page_needs_nothing_else(tmp_path: Path) -> None:
    for name in ("page.html", "again.html"):
        write_page(tmp_path / name, "<scan> & {{title}}", sphere_with_points(), [("rms", "</script>")])
    page = (tmp_path / "page.html").read_text()
    assert page == (tmp_path / "again.html").read_text()
    assert page.count("&lt;scan&gt; &amp; {{title}}") == 2
    assert page.count("</script>") == 2
    referred = re.findall(r"""\b(?:src|href|url)\s*[=(]\s*["']?([^"'\s)>]+)""", page.split("</style>")[0])
    assert referred == ["data:,"]
    assert set(re.findall(r"https?://[^\"'` )]*", page)) == {"http://www.w3.org/1999/xhtml"}  # a name, not an address
    assert not re.search(r"fetch\(|XMLHttpRequest|WebSocket|importScripts", page)
    with pytest.raises(UsageError, match="extension"):
        write_page(tmp_path / "page.pdf", "sphere", sphere_with_points())


def test_20_000_faces_with_100_000_points_are_less_than_5_megabytes(tmp_path: Path) -> None:
    x, y = np.divmod(np.arange(101 * 101), 101)
    vertices = np.column_stack([x, y, np.sin(x / 9) * np.cos(y / 7)]).astype(np.float64)
    corners = (101 * np.arange(100)[:, None] + np.arange(100)).ravel()
    faces = np.vstack([corners[:, None] + [0, 101, 102], corners[:, None] + [0, 102, 1]])
    points = np.random.default_rng(0).uniform(0, 100, (100_000, 3))
    attributes = {name: np.arange(len(points)) % 256 for name in ("red", "green", "blue", "intensity")}
    shapes = [mesh_shape("mesh", vertices, faces, points[:100]), point_shape("points", points, attributes=attributes)]
    write_page(tmp_path / "page.html", "waves", shapes)
    assert (tmp_path / "page.html").stat().st_size < 5e6


def test_colors_side_by_side_mean_the_same(tmp_path: Path) -> None:
    one, other = sphere_with_points()
    far = Coloring(DISTANCE, np.full(2_000, 7.0), 0.0, 7.0, "")
    write_page(tmp_path / "page.html", "sphere", [one, replace(other, colorings=(far,))])
    marks = [
        coloring["marks"]
        for shape in scene_of(tmp_path / "page.html")["shapes"]
        for coloring in shape["colorings"]
        if coloring["name"] == DISTANCE
    ]
    assert marks == [["0", "3.5", "7"]] * 2


@pytest.mark.parametrize("up", [1, 2])
def test_ellipsoids_stand_as_their_surface_does(tmp_path: Path, up: int) -> None:
    cone = trimesh.creation.cone(0.5, 1.0)
    sampled, rows = trimesh.sample.sample_surface(cone, 2_000, seed=0)
    centres, normals = (np.roll(each, up - 2, axis=1) for each in (sampled, cone.face_normals[rows]))
    axes = frames(normals, np.roll(normals, 1, axis=1)) * 0.1
    write_page(tmp_path / "page.html", "cone", [EllipsoidShape("tensors", centres, axes, 0.1, ())])
    assert scene_of(tmp_path / "page.html")["up"] == np.eye(3)[up].tolist()


def test_what_is_unknown_is_neither_end_of_a_ramp() -> None:
    encoded = encoded_coloring(Coloring("k", np.array([np.nan, -1.0, 1, 2, 4, 9, np.inf]), 1, 4, "", logarithmic=True))
    assert list(b64decode(encoded["values"])) == [UNKNOWN, UNKNOWN, 0, 127, 254, 254, UNKNOWN]


def test_distances_are_those_of_the_points() -> None:
    vertices, faces = meshes.icosphere()
    outside = 1.25 * vertices[faces].mean(axis=1)
    upper = outside[outside[:, 2] > 0]
    distance = next(each for each in mesh_shape("mesh", vertices, faces, upper).colorings if each.name == DISTANCE)
    assert np.nanmin(distance.values) > 0.2 * np.linalg.norm(vertices[0])
    assert np.isnan(distance.values[vertices[:, 2] < -0.1]).all()


def test_strays_neither_end_the_ramp_nor_colour_the_mesh() -> None:
    vertices, faces = meshes.icosphere()
    ball = 1.25 * np.linalg.norm(vertices[0]) * clouds.sphere(20_000)[0]
    strays = 50 * clouds.sphere(200)[0]

    def shown(points: NDArray[np.float64]) -> Coloring:
        shape = mesh_shape("mesh", vertices, faces, points)
        return next(each for each in shape.colorings if each.name == DISTANCE and isinstance(each, Coloring))

    clean, strayed = shown(ball), shown(np.vstack([ball, strays]))
    assert strayed.high == pytest.approx(clean.high, rel=0.1)
    np.testing.assert_allclose(strayed.values, clean.values, rtol=0.1)


def test_attributes_can_be_shown() -> None:
    points = clouds.sphere(10)[0]
    colors = {name: np.full(10, value, np.uint16) for name, value in (("red", 65_535), ("green", 257), ("blue", 0))}
    others = {"intensity": np.arange(10.0), "label": np.array(["a"] * 10), "sensor": points}
    shown = point_shape("points", points, attributes=colors | others).colorings
    assert [each.name for each in shown] == ["colour", "intensity"]
    assert isinstance(shown[0], OwnColors)
    assert shown[0].values[0].tolist() == [255, 1, 0]


def test_edges_are_hidden_at_first_where_the_scan_has_colors(tmp_path: Path) -> None:
    vertices, faces = meshes.icosphere()
    colored = mesh_shape(
        "mesh", vertices, faces, attributes=dict.fromkeys(("red", "green", "blue"), np.arange(len(vertices)))
    )
    for coloring, edges in (("colour", False), ("curvature", True), ("", True)):
        write_page(tmp_path / "page.html", "sphere", [colored], coloring=coloring)
        assert scene_of(tmp_path / "page.html")["edges"] == edges


def test_any_mesh_and_cloud_can_be_viewed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    vertices, faces = meshes.icosphere()
    write_mesh(tmp_path / "mesh.ply", vertices, faces)
    (tmp_path / "scan.xyz").write_text("".join(f"{x} {y} {z}\n" for x, y, z in vertices))
    files = [str(tmp_path / name) for name in ("mesh.ply", "scan.xyz")]
    assert run(["view", *files, "--page", str(tmp_path / "page.html")]) == 0
    scene = scene_of(tmp_path / "page.html")
    assert [each["kind"] for each in scene["shapes"]] == ["mesh", "points"]
    assert [each["name"] for each in scene["shapes"][0]["colorings"]] == [DISTANCE, "curvature", "stretch"]
    assert run(["view", str(tmp_path / "missing.ply"), "--page", str(tmp_path / "page.html")]) == 3
    assert "There is no file" in capsys.readouterr().err


@pytest.mark.slow
def test_a_browser_shows_a_page_without_complaint(tmp_path: Path) -> None:
    browser, page = Browser(tmp_path), tmp_path / "page.html"
    shapes = sphere_with_points()
    write_page(page, "sphere", shapes)
    front_and_back = 2 * len(shapes[0].faces)  # type: ignore[union-attr]
    assert browser.drawn(page, "points=1") == (front_and_back, 2_000)
    colored = browser.picture(page, "second=1&coloring=curvature&edges=0")
    reddish = colored[:, :, 0] - colored[:, :, 2] > 40
    assert reddish[:, :400].mean() > 0.05
    assert not reddish[:, 400:].any()
    assert (colored[:, 400:] < 230).all(axis=2).mean() > 0.05


def test_what_was_filled_is_told_from_what_was_measured() -> None:
    """A patch across a hole need not have a vertex of its own."""
    vertices, faces = meshes.icosphere()
    vertices = vertices / np.linalg.norm(vertices[0])
    points = clouds.sphere(20_000)[0]
    measured = mesh_shape("ball", vertices, faces, points)
    assert len(measured.vertices) == len(vertices)
    holed = mesh_shape("ball", vertices, faces, points[points[:, 2] > -0.5])
    distances = next(each.values for each in holed.colorings if each.name == DISTANCE)
    unknown = np.isnan(distances[holed.faces]).all(axis=1)
    centres = holed.vertices[holed.faces].mean(axis=1)
    assert unknown[centres[:, 2] < -0.7].all()
    assert not unknown[centres[:, 2] > -0.4].any()
    np.testing.assert_array_equal(holed.vertices[holed.faces], vertices[faces])


@pytest.mark.parametrize("depth", [1.0, 255, 65535])
@pytest.mark.parametrize("names", [("r", "g", "b"), ("diffuse_red", "diffuse_green", "diffuse_blue"), ("colors",)])
def test_colours_are_colours_by_whatever_name(names: tuple[str, ...], depth: float) -> None:
    points = clouds.sphere(3)[0]
    colors = np.array([[0, 1, 0], [1, 1, 0], [0, 0, 1]]) * depth
    colors = colors if isinstance(depth, float) else colors.astype(np.uint16)
    attributes = {"colors": colors} if len(names) == 1 else dict(zip(names, colors.T, strict=True))
    (shown,) = point_shape("points", points, attributes=attributes).colorings
    assert isinstance(shown, OwnColors)
    assert shown.values.tolist() == (colors / depth * 255).tolist()
