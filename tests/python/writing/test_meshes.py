# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes written and read back, here and by trimesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from helpers.clouds import sphere_points
from helpers.meshes import TETRAHEDRON_FACES, tetrahedron
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.reading import read_points
from hdpea.reading.formats import parse_points
from hdpea.reading.triangle_mesh import parse_triangle_mesh
from hdpea.writing.meshes import MESH_FORMATS, write_mesh
from hdpea.writing.points import write_points

EXACT_FORMATS = (".obj", ".ply", ".off")
coordinates = st_numpy.arrays(np.float64, (4, 3), elements=st.floats(-1e12, 1e12), unique=True)


def read_mesh(path: Path) -> trimesh.Trimesh:
    if path.suffix == ".glb":  # has axes of its own
        return trimesh.Trimesh(*parse_triangle_mesh(path), process=False)
    loaded = trimesh.load(path, process=False)
    return loaded.to_geometry() if isinstance(loaded, trimesh.Scene) else loaded


@pytest.mark.parametrize("extension", MESH_FORMATS)
def test_the_same_mesh_comes_back(extension: str, tmp_path: Path) -> None:
    write_mesh(tmp_path / f"mesh{extension}", tetrahedron(), TETRAHEDRON_FACES)
    mesh = read_mesh(tmp_path / f"mesh{extension}")
    np.testing.assert_allclose(mesh.triangles, tetrahedron()[TETRAHEDRON_FACES], atol=1e-7)
    assert mesh.volume == pytest.approx(1 / 6)


@pytest.mark.parametrize("extension", EXACT_FORMATS)
def test_faces_keep_their_order_and_indices(extension: str, tmp_path: Path) -> None:
    write_mesh(tmp_path / f"mesh{extension}", tetrahedron(), TETRAHEDRON_FACES)
    np.testing.assert_array_equal(read_mesh(tmp_path / f"mesh{extension}").faces, TETRAHEDRON_FACES)


@pytest.mark.parametrize("extension", EXACT_FORMATS)
@given(vertices=coordinates)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=30)
def test_every_digit_comes_back(extension: str, tmp_path: Path, vertices: NDArray[np.float64]) -> None:
    write_mesh(tmp_path / f"mesh{extension}", vertices, TETRAHEDRON_FACES)
    # Not by read_points, to which points that differ by rounding, beside others far away, are one.
    written = (tmp_path / f"mesh{extension}").read_bytes()
    np.testing.assert_array_equal(parse_points(written, extension).points, vertices)


@pytest.mark.parametrize("extension", MESH_FORMATS)
def test_millimetres_at_ten_million_metres_survive(extension: str, tmp_path: Path) -> None:
    vertices = tetrahedron(center=1e7, size=0.123)
    write_mesh(tmp_path / f"mesh{extension}", vertices, TETRAHEDRON_FACES)
    found = read_mesh(tmp_path / f"mesh{extension}").triangles
    np.testing.assert_allclose(found, vertices[TETRAHEDRON_FACES], rtol=0, atol=2e-8)


def test_stl_is_binary_unless_single_precision_would_hurt(tmp_path: Path) -> None:
    write_mesh(tmp_path / "near.stl", tetrahedron(), TETRAHEDRON_FACES)
    write_mesh(tmp_path / "far.stl", tetrahedron(center=1e7, size=0.125), TETRAHEDRON_FACES)
    assert b"facet" not in (tmp_path / "near.stl").read_bytes()
    assert b"vertex 10000000.125" in (tmp_path / "far.stl").read_bytes()


@pytest.mark.parametrize("extension", MESH_FORMATS)
@pytest.mark.parametrize("size", [1e-50, 1e50])
def test_meshes_may_be_of_any_size(extension: str, size: float, tmp_path: Path) -> None:
    write_mesh(tmp_path / f"mesh{extension}", tetrahedron(size=size), TETRAHEDRON_FACES)
    found = read_mesh(tmp_path / f"mesh{extension}").triangles / size
    np.testing.assert_allclose(found, tetrahedron()[TETRAHEDRON_FACES], atol=1e-6)


@pytest.mark.parametrize(
    ("vertices", "faces", "reason"),
    [
        (np.ones((4, 2)), TETRAHEDRON_FACES, "vertices are"),
        (np.full((4, 3), np.nan), TETRAHEDRON_FACES, "finite"),
        (tetrahedron(), TETRAHEDRON_FACES + 1, "no vertex"),
        (tetrahedron(), TETRAHEDRON_FACES - 1, "no vertex"),
        (tetrahedron(), TETRAHEDRON_FACES[:, :2], "faces are"),
        (tetrahedron(), TETRAHEDRON_FACES / 2, "faces are"),
    ],
)
def test_what_is_no_mesh_is_not_written(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], reason: str, tmp_path: Path
) -> None:
    with pytest.raises(UsageError, match=reason):
        write_mesh(tmp_path / "mesh.obj", vertices, faces)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("attributes", "reason"),
    [
        ({"label": np.ones(3)}, "'label' is float64 of shape"),
        ({"label": np.array(list("abcd"))}, "'label' is <U1"),
        ({"label": np.ones((4, 2, 2))}, "'label' is float64"),
        ({"x": np.ones(4)}, "name of a coordinate"),
    ],
)
def test_what_is_no_attribute_is_not_written(attributes: dict[str, NDArray[Any]], reason: str, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=reason):
        write_mesh(tmp_path / "mesh.ply", tetrahedron(), TETRAHEDRON_FACES, attributes)
    assert list(tmp_path.iterdir()) == []


def test_ply_holds_attributes_of_every_type(tmp_path: Path) -> None:
    values = np.array([0, 1, 2, 3])
    kinds = {name: values.astype(name) for name in ("int8", "uint16", "int32", "uint32", "int64", "float32", "float64")}
    attributes = {**kinds, "bool": values > 1, "large": values + 2**40, "a name": values}
    write_mesh(tmp_path / "mesh.ply", tetrahedron(), TETRAHEDRON_FACES, attributes)
    found = read_points(tmp_path / "mesh.ply").attributes
    assert set(found) == {*kinds, "bool", "large", "a_name"}
    for name, column in attributes.items():
        np.testing.assert_array_equal(found[name.replace(" ", "_")], column)


def test_an_empty_mesh_is_a_legal_file(tmp_path: Path) -> None:
    for extension in MESH_FORMATS:
        write_mesh(tmp_path / f"mesh{extension}", np.empty((0, 3)), np.empty((0, 3), dtype=np.int64))
        assert (tmp_path / f"mesh{extension}").exists()


@pytest.mark.parametrize("extension", [".npz", ".ply"])
def test_embedded_points_come_back(extension: str, tmp_path: Path) -> None:
    points, embedding = 1e7 + sphere_points(9), np.random.default_rng(1).normal(size=(9, 8))
    places = np.arange(9)[::-1] + 5
    write_points(tmp_path / f"points{extension}", points, sphere_points(9), embedding, places)
    cloud = read_points(tmp_path / f"points{extension}")
    np.testing.assert_array_equal(cloud.points, points)
    np.testing.assert_allclose(cloud.normals, sphere_points(9), atol=1e-15)
    attributes = dict(cloud.attributes)
    np.testing.assert_array_equal(attributes.pop("point_index"), places)
    columns = attributes.get("coordinates", np.stack(list(attributes.values()), axis=-1))
    np.testing.assert_array_equal(columns, embedding)


def test_unknown_extension_is_a_usage_error(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="extension"):
        write_mesh(tmp_path / "mesh.fbx", tetrahedron(), TETRAHEDRON_FACES)
