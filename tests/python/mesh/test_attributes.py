# SPDX-License-Identifier: GPL-3.0-or-later
"""What the points have arrives at the vertices."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from helpers import clouds
from numpy.typing import NDArray

from hdpea import Reconstruction, _core, reconstruct
from hdpea.errors import UsageError
from hdpea.geometry.color import linear_of_srgb, srgb_of_linear
from hdpea.reading.attributes import split_colors

Array = NDArray[np.float64]
POINTS = clouds.sphere_points(8_000)
EVERYWHERE = clouds.sphere_points(3_000, seed=7)


def paint(points: Array) -> Array:
    """Return a smooth colour (n, 3) of each point, sRGB from 0 to 1."""
    x, y, z = points.T
    return 0.5 + np.stack([0.4 * np.sin(2 * x), 0.4 * np.cos(2 * y), 0.3 * z + 0.1 * np.sin(3 * x * y)], axis=1)


@pytest.fixture(scope="module")
def painted() -> Reconstruction:
    """Return a sphere with colours of 16 bits, times of a week, classes of its halves, and a hole in its heights."""
    height = np.where(POINTS[:, 2] > 0.9, np.nan, POINTS[:, 2])
    attributes = {
        **dict(zip(("red", "green", "blue"), np.rint(65535 * paint(POINTS)).astype(np.uint16).T, strict=True)),
        "gps_time": 3e8 + POINTS[:, 0],
        "scalar_Classification": np.where(POINTS[:, 0] > 0, 6.0, 2.0),
        "intensity": np.rint(1000 + 500 * POINTS[:, 1]).astype(np.uint16),
        "height": height,
        "place": POINTS,
        "sensor": POINTS,
    }
    return reconstruct(POINTS, POINTS, attributes=attributes)


def at_samples(mesh: Reconstruction, values: Array) -> Array:
    """Return values (v, c) of the vertices at points of the mesh, as a renderer has them."""
    feet = _core.closest_surface_points(mesh.vertices, mesh.faces, EVERYWHERE)
    return np.einsum("nk,nkc->nc", feet.barycentric, values[mesh.faces[feet.face]])


def test_colours_are_those_of_the_points_however_they_are_interpolated(painted: Reconstruction) -> None:
    srgb = np.stack([painted.attributes[name] for name in ("red", "green", "blue")], axis=1) / 255
    in_ply, in_glb = at_samples(painted, srgb), srgb_of_linear(at_samples(painted, linear_of_srgb(srgb)))
    for colors in (in_ply, in_glb):
        errors = 255 * abs(colors - paint(EVERYWHERE)).max(axis=1)
        assert np.percentile(errors, 95) < 2


def test_fine_stripes_do_not_overshoot() -> None:
    stripes = np.where(np.sin(25 * POINTS[:, 2]) > 0, 200, 60).astype(np.uint8)
    mesh = reconstruct(POINTS, POINTS, vertices=150, attributes=dict.fromkeys(("red", "green", "blue"), stripes))
    assert 60 <= mesh.attributes["red"].min() <= mesh.attributes["red"].max() <= 200


def test_quantities_are_means_in_their_own_type(painted: Reconstruction) -> None:
    x, y, z = (painted.vertices / np.linalg.norm(painted.vertices, axis=1, keepdims=True)).T
    attributes = painted.attributes
    np.testing.assert_allclose(attributes["gps_time"] - 3e8, x, atol=0.04)
    assert attributes["intensity"].dtype == np.uint16
    np.testing.assert_allclose(attributes["intensity"], 1000 + 500 * y, atol=20)
    np.testing.assert_allclose(attributes["place"], np.stack([x, y, z], axis=1), atol=0.04)


def test_labels_are_elected(painted: Reconstruction) -> None:
    x = painted.vertices[:, 0]
    labels = painted.attributes["scalar_Classification"]
    assert set(np.unique(labels)) == {2.0, 6.0}
    clear = abs(x) > 0.1
    np.testing.assert_array_equal(labels[clear], np.where(x > 0, 6, 2)[clear])


def test_what_is_unknown_comes_from_the_nearest_point_that_knows(painted: Reconstruction) -> None:
    height, z = painted.attributes["height"], painted.vertices[:, 2]
    np.testing.assert_allclose(height, np.minimum(z, 0.9), atol=0.04)


def test_where_points_were_seen_from_is_no_attribute_of_the_surface(painted: Reconstruction) -> None:
    assert "sensor" not in painted.attributes


def test_the_two_sides_of_a_thin_wall_keep_their_colours() -> None:
    points, normals = clouds.hollow_sphere(8000, spacings_thick=1.5)
    outside = np.einsum("nc,nc->n", points, normals) > 0
    mesh = reconstruct(points, normals, vertices=1000, attributes={"side": np.where(outside, 1.0, 0.0)})
    radius = np.linalg.norm(mesh.vertices, axis=1)
    middle = np.linalg.norm(points, axis=1).mean()
    assert np.mean(abs(mesh.attributes["side"] - (radius > middle)) < 0.05) > 0.99


def test_a_cloud_without_attributes_has_none() -> None:
    assert reconstruct(*clouds.sphere(1000), vertices=100).attributes == {}


def test_srgb_and_linear_light_are_inverse() -> None:
    values = np.linspace(0, 1, 256)
    np.testing.assert_allclose(srgb_of_linear(linear_of_srgb(values)), values, atol=1e-6)
    assert linear_of_srgb(np.array([0.5]))[0] == pytest.approx(0.2140, abs=1e-4)


@pytest.mark.parametrize(
    ("attributes", "white"),
    [
        ({"red": np.uint8(255), "green": np.uint8(255), "blue": np.uint8(255)}, 1.0),
        ({"Red": np.uint16(255), "Green": np.uint16(51), "Blue": np.uint16(0)}, 1.0),
        ({"red": np.uint16(65535), "green": np.uint16(0), "blue": np.uint16(0)}, 1.0),
        ({"red": 255.0, "green": 1.0, "blue": 0.0}, 1.0),
        ({"r": 1.0, "g": 0.5, "b": 0.0}, 1.0),
        ({"red": np.uint8(1), "green": np.uint8(1), "blue": np.uint8(0)}, 1 / 255),
        ({"diffuse_red": np.uint8(255), "diffuse_green": np.uint8(0), "diffuse_blue": np.uint8(0)}, 1.0),
    ],
)
def test_colours_of_any_depth_are_understood(attributes: dict[str, Any], white: float) -> None:
    colors, others = split_colors({name: np.array([value]) for name, value in attributes.items()} | {"a": np.ones(1)})
    assert colors is not None
    assert colors.max() == pytest.approx(white)
    assert set(others) == {"a"}


@pytest.mark.parametrize("values", [[-1.0, 0.5], [1e6, 0.0], ["a", "b"]])
def test_what_cannot_be_colours_stays_what_it_is(values: list[Any]) -> None:
    columns = {name: np.array(values) for name in ("red", "green", "blue")}
    assert split_colors(columns) == (None, columns)


def test_attributes_are_one_for_each_point() -> None:
    with pytest.raises(UsageError, match="`attributes` has 'label' of"):
        reconstruct(POINTS, attributes={"label": np.ones(3)})


def test_ply_holds_every_attribute_and_obj_the_colours(painted: Reconstruction, tmp_path: Path) -> None:
    from hdpea import read_points, write_mesh

    for extension in (".ply", ".obj"):
        write_mesh(tmp_path / f"mesh{extension}", painted.vertices, painted.faces, painted.attributes)
    ply, obj = (read_points(tmp_path / f"mesh{extension}").attributes for extension in (".ply", ".obj"))
    for name in ("red", "green", "blue", "gps_time", "intensity", "height"):
        np.testing.assert_array_equal(ply[name], painted.attributes[name])
        assert ply[name].dtype == painted.attributes[name].dtype
    np.testing.assert_array_equal(ply["place_2"], painted.attributes["place"][:, 2])
    for name in ("red", "green", "blue"):
        np.testing.assert_array_equal(np.rint(255 * obj[name]), painted.attributes[name])
