# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes from files and from Thingi10K, whose package is stood in for where it would go to the network."""

from __future__ import annotations

import sys
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
import trimesh
from helpers.dataset_standins import open_mesh
from helpers.files import WITH_NORMALS

from hdpea.dataset.discovery import find_clouds, find_meshes
from hdpea.dataset.surface_file import read_surface
from hdpea.errors import CannotReconstruct, UnreadableInput, UsageError


def volume(vertices: np.ndarray[Any, Any], faces: np.ndarray[Any, Any]) -> float:
    return float(trimesh.Trimesh(vertices, faces, process=False).volume)


@pytest.mark.parametrize("extension", ["ply", "obj", "stl", "off", "glb"])
def test_a_surface_is_the_same_from_every_format(extension: str, tmp_path: Path) -> None:
    trimesh.creation.box((1, 2, 3)).export(tmp_path / f"box.{extension}")
    vertices, faces = read_surface(tmp_path / f"box.{extension}")
    assert (vertices.shape, faces.shape) == ((8, 3), (12, 3))
    assert volume(vertices, faces) == pytest.approx(6)


def test_a_surface_that_is_inside_out_is_turned(tmp_path: Path) -> None:
    box = trimesh.creation.box()
    box.invert()
    box.export(tmp_path / "box.ply")
    assert volume(*read_surface(tmp_path / "box.ply")) == pytest.approx(1)


def _two_orientations(path: Path) -> None:
    box = trimesh.creation.box()
    faces = np.array(box.faces)
    faces[0] = faces[0, ::-1]
    trimesh.Trimesh(box.vertices, faces, process=False).export(path)


def _fin(path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=1)
    fin = trimesh.Trimesh([[0, 0, 0], *ball.vertices[ball.faces[0, :2]]], [[0, 1, 2], [0, 2, 1]], process=False)
    trimesh.util.concatenate([ball, fin]).export(path)


@pytest.mark.parametrize(
    ("write", "told"),
    [
        (open_mesh, "3 edges at holes"),
        (_two_orientations, "3 edges between faces of opposite orientation"),
        (_fin, "1 edges of more than two faces"),
    ],
)
def test_a_surface_without_inside_and_outside_is_refused(write: Any, told: str, tmp_path: Path) -> None:
    write(tmp_path / "mesh.ply")
    with pytest.raises(CannotReconstruct, match=told):
        read_surface(tmp_path / "mesh.ply")


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("mesh.ply", b"ply\nnonsense", "no mesh, or damaged"),
        ("mesh.stl", b"", "no faces"),
        ("mesh.npz", b"PK\x03\x04", "no mesh, or damaged"),
        ("mesh.step", b"ISO", "extension '.step' is unknown"),
        ("mesh.off", b"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no faces"),
        ("mesh.off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", "not finite"),
    ],
)
def test_what_is_no_mesh_is_told_so(name: str, content: bytes, told: str, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(UnreadableInput, match=told) as caught:
        read_surface(tmp_path / name)
    assert name in caught.value.message


def test_a_single_file_is_a_source(tmp_path: Path) -> None:
    trimesh.creation.box().export(tmp_path / "box.ply")
    (found,) = find_meshes(str(tmp_path / "box.ply"))
    assert (found.name, found.source, found.licence) == ("box", "box.ply", "unstated")


def test_clouds_are_found_in_every_format_that_is_read(tmp_path: Path) -> None:
    for name, content in WITH_NORMALS.items():
        (tmp_path / name).write_bytes(content)
    found = find_clouds(str(tmp_path))
    assert {each.source for each in found} == WITH_NORMALS.keys() - {"no_extension"}
    assert [each.name for each in found] == sorted(each.name for each in found)
    assert len({each.name for each in found}) == len(found)
    (single,) = find_clouds(str(tmp_path / "plain.xyz"))
    assert (single.name, single.path) == ("plain", tmp_path / "plain.xyz")


def test_no_clouds_are_told(tmp_path: Path) -> None:
    (tmp_path / "mesh.stl").touch()
    with pytest.raises(UnreadableInput, match="no point clouds in"):
        find_clouds(str(tmp_path))
    with pytest.raises(UnreadableInput, match="no file or folder"):
        find_clouds(str(tmp_path / "absent"))


@pytest.fixture
def thingi10k(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """Stand in for the package: init downloads, dataset lists what there is by columns of these names."""
    ball = trimesh.creation.icosphere(subdivisions=1)
    np.savez(tmp_path / "7.npz", vertices=ball.vertices, facets=np.asarray(ball.faces, np.int32))
    entry = {"file_id": 7, "thing_id": 5, "file_path": str(tmp_path / "7.npz"), "author": "someone", "name": "ball"}
    package: Any = ModuleType("thingi10k")
    package.__spec__ = ModuleSpec("thingi10k", None)
    package.init = lambda: None
    package.dataset = lambda file_id: [each for each in [{**entry, "license": "CC BY"}] if each["file_id"] in file_id]
    monkeypatch.setitem(sys.modules, "thingi10k", package)
    return package


def test_models_of_thingi10k_come_with_their_licence(thingi10k: ModuleType) -> None:
    assert thingi10k
    (found,) = find_meshes("thingi10k:7,7")
    assert (found.name, found.source, found.licence) == ("thingi10k_7", "thingi10k:7", "CC BY")
    assert found.origin == "thingiverse.com/thing:5: ball by someone"
    vertices, faces = read_surface(found.path)
    assert volume(vertices, faces) > 3


def test_models_that_thingi10k_has_not_are_told(thingi10k: ModuleType) -> None:
    assert thingi10k
    with pytest.raises(UsageError, match="no model 8"):
        find_meshes("thingi10k:7,8")
    with pytest.raises(UsageError, match="are not IDs"):
        find_meshes("thingi10k:seven")


def test_no_network_is_told(thingi10k: Any) -> None:
    def init() -> None:
        raise RuntimeError("Failed to initialize dataset: no route to host")

    thingi10k.init = init
    with pytest.raises(UnreadableInput, match=r"cannot be downloaded or read: .*no route"):
        find_meshes("thingi10k:7")


def test_without_the_package_it_is_told_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.dataset.thingi10k.find_spec", lambda _: None)
    with pytest.raises(UsageError, match="not installed") as caught:
        find_meshes("thingi10k:7")
    assert "hdpea[thingi10k]" in caught.value.hint
