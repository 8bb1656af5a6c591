# SPDX-License-Identifier: GPL-3.0-or-later
"""GLB files are what browsers, Blender and the validator of Khronos expect."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from helpers.glb import parts_of, require_validator, validator_messages
from helpers.meshes import TETRAHEDRON_FACES, tetrahedron
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.geometry.color import linear_of_srgb
from hdpea.reading.glb import colors_at
from hdpea.reading.triangle_mesh import parse_triangle_mesh
from hdpea.writing.meshes import write_mesh

UTM = np.array([456_789.25, 5_678_901.5, 123.0])

COLORS = {
    "red": np.array([255, 128, 3, 0], np.uint8),
    "green": np.array([0, 10, 20, 255], np.uint8),
    "blue": np.array([1, 2, 4, 8], np.uint8),
}


def written(folder: Path, vertices: NDArray[np.float64], **options: Any) -> Path:
    write_mesh(folder / "mesh.glb", vertices, TETRAHEDRON_FACES, **options)
    return folder / "mesh.glb"


def test_y_is_up_and_faces_still_face_out(tmp_path: Path) -> None:
    _, arrays = parts_of(written(tmp_path, tetrahedron()))
    np.testing.assert_allclose(arrays["POSITION"][9:], [[0, 1, 0]] * 3)  # the one with z = 1, of three faces
    volume = trimesh.Trimesh(arrays["POSITION"], arrays["indices"].reshape(-1, 3), process=False).volume
    assert volume == pytest.approx(1 / 6)


def test_normals_are_unit_and_point_out(tmp_path: Path) -> None:
    _, arrays = parts_of(written(tmp_path, tetrahedron()))
    np.testing.assert_allclose(np.linalg.norm(arrays["NORMAL"], axis=1), 1, atol=1e-6)
    outward = arrays["POSITION"] - arrays["POSITION"].mean(axis=0)
    assert (np.einsum("vc,vc->v", arrays["NORMAL"], outward) > 0).all()


def test_colours_are_linear_light(tmp_path: Path) -> None:
    _, arrays = parts_of(written(tmp_path, tetrahedron(), attributes=COLORS))
    srgb = np.stack(list(COLORS.values()), axis=1) / 255
    of_each_face = np.repeat(linear_of_srgb(srgb), 3, axis=0)
    np.testing.assert_allclose(arrays["COLOR_0"][:, :3] / 65535, of_each_face, atol=1e-5)
    assert (arrays["COLOR_0"][:, 3] == 65535).all()


def test_vertices_are_split_at_creases_alone_and_read_back_whole(tmp_path: Path) -> None:
    cube, sphere = trimesh.creation.box(), trimesh.creation.icosphere(subdivisions=2)
    for mesh, expected in ((cube, 24), (sphere, len(sphere.vertices))):
        write_mesh(tmp_path / "mesh.glb", mesh.vertices, mesh.faces)
        _, arrays = parts_of(tmp_path / "mesh.glb")
        assert len(arrays["POSITION"]) == expected
        vertices, faces = parse_triangle_mesh(tmp_path / "mesh.glb")
        np.testing.assert_allclose(vertices, mesh.vertices, atol=1e-6)
        np.testing.assert_array_equal(faces, mesh.faces)


def test_normals_at_creases_are_those_of_the_sides(tmp_path: Path) -> None:
    cube = trimesh.creation.box()
    write_mesh(tmp_path / "mesh.glb", cube.vertices, cube.faces)
    _, arrays = parts_of(tmp_path / "mesh.glb")
    np.testing.assert_allclose(abs(arrays["NORMAL"]).max(axis=1), 1, atol=1e-6)


@pytest.mark.parametrize("up", ["z", "y", "-y"])
def test_what_is_up_becomes_y_and_is_read_back(up: str, tmp_path: Path) -> None:
    path = written(tmp_path, tetrahedron(), up=up)
    tip = {"z": [0, 1, 0], "y": [0, 0, 1], "-y": [0, 0, -1]}[up]
    np.testing.assert_allclose(parts_of(path)[1]["POSITION"][9], tip)
    np.testing.assert_allclose(parse_triangle_mesh(path)[0], tetrahedron(), atol=1e-6)


def test_a_shape_that_stands_on_its_y_side_is_not_turned(tmp_path: Path) -> None:
    cone = trimesh.creation.cone(radius=0.5, height=2)
    standing = cone.vertices[:, [1, 2, 0]]
    write_mesh(tmp_path / "mesh.glb", standing, cone.faces)
    positions = parts_of(tmp_path / "mesh.glb")[1]["POSITION"]
    assert np.ptp(positions[:, 1]) == pytest.approx(2)


def test_no_file_of_others_is_replaced_unless_forced(tmp_path: Path) -> None:
    (tmp_path / "mesh.glb").write_text("somebody else's")
    with pytest.raises(UsageError, match="no mesh that hdpea made"):
        written(tmp_path, tetrahedron())
    written(tmp_path, tetrahedron(), force=True)
    written(tmp_path, tetrahedron())


def test_what_needs_no_shift_has_none_and_no_file_beside_it(tmp_path: Path) -> None:
    tree, _ = parts_of(written(tmp_path, tetrahedron(center=5)))
    extras = tree["nodes"][0]["extras"]
    assert (extras["shift"], extras["unit"], extras["up"]) == ([0, 0, 0], "metre", "y")
    assert [each.name for each in tmp_path.iterdir()] == ["mesh.glb"]


def test_a_georeferenced_mesh_is_shifted_and_the_shift_is_told(tmp_path: Path) -> None:
    vertices = tetrahedron(size=0.1) + UTM
    tree, arrays = parts_of(written(tmp_path, vertices, crs="EPSG:25832"))
    assert "translation" not in tree["nodes"][0]
    beside = json.loads((tmp_path / "mesh.glb.world.json").read_text())
    assert beside == tree["nodes"][0]["extras"]
    assert beside["crs"] == "EPSG:25832"
    world = {"shift": beside["shift"], **dict(zip("xyz", arrays["POSITION"].astype(float).T, strict=True))}
    found = np.stack([eval(axis, {}, world) for axis in beside["world"]], axis=1)  # noqa: S307 it is our own
    np.testing.assert_allclose(found, np.repeat(vertices, 3, axis=0), rtol=0, atol=1e-7)
    np.testing.assert_allclose(parse_triangle_mesh(tmp_path / "mesh.glb")[0], vertices, rtol=0, atol=1e-7)


def test_a_mesh_that_is_not_shifted_leaves_no_shift_of_an_earlier_one(tmp_path: Path) -> None:
    written(tmp_path, tetrahedron(size=0.1) + UTM)
    written(tmp_path, tetrahedron())
    assert [each.name for each in tmp_path.iterdir()] == ["mesh.glb"]
    beside = tmp_path / "mesh.glb.world.json"
    beside.write_text("somebody else's")
    written(tmp_path, tetrahedron())
    assert beside.exists()


def test_other_formats_say_their_crs_beside_them(tmp_path: Path) -> None:
    write_mesh(tmp_path / "mesh.obj", tetrahedron(), TETRAHEDRON_FACES, crs="EPSG:25832")
    beside = json.loads((tmp_path / "mesh.obj.world.json").read_text())
    assert (beside["crs"], beside["shift"], beside["up"]) == ("EPSG:25832", [0, 0, 0], "z")


def test_colours_are_read_as_they_were_written(tmp_path: Path) -> None:
    path = written(tmp_path, tetrahedron(), attributes=COLORS)
    read = colors_at(path, parse_triangle_mesh(path)[0])
    for name, values in COLORS.items():
        np.testing.assert_allclose(read[name].astype(int), values, atol=3)  # in 8 bits of light, dark ones are coarse


def test_glb_of_another_program_is_read_as_it_is(tmp_path: Path) -> None:
    trimesh.Trimesh(tetrahedron(), TETRAHEDRON_FACES, process=False).export(tmp_path / "other.glb")
    np.testing.assert_allclose(parse_triangle_mesh(tmp_path / "other.glb")[0], tetrahedron())


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["plain", "coloured", "georeferenced", "huge", "empty"])
def test_the_validator_of_khronos_is_silent(kind: str, tmp_path: Path) -> None:
    require_validator()
    path = tmp_path / "mesh.glb"
    sphere = trimesh.creation.icosphere(subdivisions=2)
    vertices, faces = np.array(sphere.vertices), np.array(sphere.faces)
    if kind == "huge":  # more vertices than 16 bits count
        vertices, faces = np.tile(vertices, (500, 1)), np.vstack([faces + i * len(vertices) for i in range(500)])
    if kind == "plain":
        write_mesh(path, vertices, faces)
    elif kind == "coloured":
        write_mesh(path, vertices, faces, {name: np.resize(values, len(vertices)) for name, values in COLORS.items()})
    elif kind == "georeferenced":
        write_mesh(path, vertices + UTM, faces, crs="EPSG:25832")
    elif kind == "huge":
        write_mesh(path, 1e50 * vertices, faces)
    else:
        write_mesh(path, np.empty((0, 3)), np.empty((0, 3), np.int64))
    assert validator_messages(path) == []
