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

from hdpea.geometry.color import linear_of_srgb
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
    np.testing.assert_allclose(arrays["POSITION"][3], [0, 1, 0])  # the one with z = 1
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
    np.testing.assert_allclose(arrays["COLOR_0"][:, :3] / 65535, linear_of_srgb(srgb), atol=1e-5)
    assert (arrays["COLOR_0"][:, 3] == 65535).all()


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
    np.testing.assert_allclose(found, vertices, rtol=0, atol=1e-7)
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
