# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands, their flags and their outputs; stand-ins where a test needs the work to go wrong."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from helpers import clouds, standins
from helpers.clouds import sphere_points

from hdpea.cli import run
from hdpea.reading import read_points
from hdpea.reconstruction import PHASES
from hdpea.writing.meshes import MESH_FORMATS

Capture = pytest.CaptureFixture[str]


def test_a_mesh_is_made_and_summed_up(scan: str, tmp_path: Path, capsys: Capture) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj"), "--verbose"]) == 0
    assert len(trimesh.load(tmp_path / "mesh.obj", process=False).faces) == 200
    told = capsys.readouterr()
    assert told.out == ""
    assert "reading ..." in told.err
    assert "vertices: 100 (one for every 8 points)" in told.err
    assert "mesh: 100 vertices, 200 faces, manifold, closed, 1 component, genus 1" in told.err
    assert "points to mesh: rms" in told.err


def test_quiet_is_silent(scan: str, tmp_path: Path, capsys: Capture) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj"), "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")


def test_the_report_knows_the_flags_and_the_stages(scan: str, tmp_path: Path) -> None:
    arguments = [
        "reconstruct",
        scan,
        str(tmp_path / "mesh.ply"),
        "--vertices",
        "80",
        "--fill-holes",
        "2%",
        "--seed",
        "5",
    ]
    assert run([*arguments, "--report", str(tmp_path / "report.json")]) == 0
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["options"]["meshing"]["vertices"] == report["mesh"]["vertices"] == 80
    assert report["options"]["meshing"]["fill_holes"] == "2%"
    assert report["options"]["particles"]["seed"] == 5
    assert report["counts"]["points"] == 800
    assert report["source"] == {"name": scan, "format": "text, 6 columns"}
    before = PHASES[: PHASES.index("repair")]
    expected = ["reading", "start-up", *before, "refinement", "repair", "measuring", "writing"]
    assert [stage["name"] for stage in report["stages"]] == expected


@pytest.mark.parametrize("extension", MESH_FORMATS)
def test_every_format_holds_the_whole_mesh(extension: str, scan: str, tmp_path: Path) -> None:
    assert run(["reconstruct", scan, str(tmp_path / f"mesh{extension}"), "--quiet"]) == 0
    mesh = trimesh.load(tmp_path / f"mesh{extension}", force="mesh")
    assert len(mesh.faces) == 200
    mesh.merge_vertices(merge_norm=True)  # GLB repeats those on creases
    assert mesh.is_watertight


@pytest.mark.slow
def test_a_picture_is_drawn(scan: str, tmp_path: Path) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj"), "--picture", str(tmp_path / "mesh.png")]) == 0
    assert (tmp_path / "mesh.png").read_bytes().startswith(b"\x89PNG")


def test_a_picture_is_taken_from_where_the_sensors_were(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    points = sphere_points(1000)
    seen = []
    monkeypatch.setattr("hdpea.pictures.picture.check_drawing", lambda: None)
    monkeypatch.setattr("hdpea.pictures.picture.draw_mesh", lambda *_, camera, **__: seen.append(camera))
    for side in (10, -10):
        np.savez(tmp_path / "scan.npz", points=points, sensor=np.tile([side, 0, 0], (1000, 1)))
        arguments = [str(tmp_path / name) for name in ("scan.npz", "mesh.obj")]
        assert run(["reconstruct", *arguments, "--picture", str(tmp_path / "mesh.png"), "--quiet"]) == 0
    assert seen[0].view_from_world[2, 0] > 0.7
    assert seen[1].view_from_world[2, 0] < -0.7


def test_an_embedding_is_written(scan: str, tmp_path: Path, capsys: Capture) -> None:
    assert run(["embed", scan, str(tmp_path / "points.npz"), "--normals", "estimate", "--json"]) == 0
    written = read_points(tmp_path / "points.npz")
    assert written.attributes["coordinates"].shape == (800, 8)
    np.testing.assert_allclose(written.points, clouds.torus(800)[0])
    told = capsys.readouterr()
    assert "bending_length: " in told.err
    assert "normal_neighbors: 16 points" in told.err
    chosen = {each["name"]: each for each in json.loads(told.out)["choices"]}
    assert chosen["normal_neighbors"]["value"] == 16
    assert chosen["bending_length"]["unit"] == "world units"


def test_normals_are_turned_to_the_sensors_that_the_file_names(tmp_path: Path) -> None:
    points, normals = clouds.torus(800)
    sensors = points - 0.1 * normals  # inside
    np.savez(tmp_path / "array.npz", points=points, sensor=sensors)
    header = "x,y,z,sensor_x,sensor_y,sensor_z"
    np.savetxt(tmp_path / "columns.csv", np.hstack([points, sensors]), delimiter=",", header=header, comments="")
    for name in ("array.npz", "columns.csv"):
        output = tmp_path / f"{name}.npz"
        assert run(["embed", str(tmp_path / name), str(output), "--orient", "viewpoint", "--quiet"]) == 0
        written = read_points(output).normals
        assert written is not None
        assert (np.einsum("nc,nc->n", written, normals) < 0).all()


def test_normals_are_turned_to_the_viewpoint(scan: str, tmp_path: Path) -> None:
    arguments = ["--orient", "viewpoint", "--viewpoint", "-1,-2,-3.5", "--report", str(tmp_path / "report.json")]
    assert run(["reconstruct", scan, str(tmp_path / "mesh.ply"), "--fill-holes", "0", *arguments]) == 0
    assert json.loads((tmp_path / "report.json").read_text())["options"]["normals"]["viewpoint"] == "-1,-2,-3.5"


def test_signs_that_the_file_lacks_are_unreadable(tmp_path: Path, failed: Callable[..., str]) -> None:
    np.savetxt(tmp_path / "scan.xyz", clouds.torus(800)[0])
    assert "no usable normals" in failed(
        3, "reconstruct", tmp_path / "scan.xyz", tmp_path / "m.obj", "--orient", "file"
    )


@pytest.mark.usefixtures("stand_ins")
def test_a_missed_target_keeps_the_mesh_but_is_an_error(scan: str, tmp_path: Path, failed: Callable[..., str]) -> None:
    assert "1 hole" in failed(5, "reconstruct", scan, tmp_path / "mesh.obj", "--watertight")
    assert (tmp_path / "mesh.obj").exists()


@pytest.mark.usefixtures("stand_ins")
def test_an_internal_error_is_one_sentence(scan: str, tmp_path: Path, failed: Callable[..., str]) -> None:
    error = failed(1, "reconstruct", scan, tmp_path / "mesh.obj", "--seed", str(standins.FAILING_SEED))
    assert "Internal error: ZeroDivisionError: a bug" in error
    assert not (tmp_path / "mesh.obj").exists()


@pytest.mark.usefixtures("stand_ins")
def test_a_traceback_is_shown_on_demand(scan: str, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HDPEA_TRACEBACK", "")
    assert run(["--debug", "reconstruct", scan, scan + ".obj", "--seed", str(standins.FAILING_SEED)]) == 1
    assert "Traceback" in capsys.readouterr().err


def test_a_missing_input_is_unreadable(tmp_path: Path, failed: Callable[..., str]) -> None:
    assert "no file" in failed(3, "reconstruct", tmp_path / "scan.ply", tmp_path / "mesh.obj")


def test_attributes_arrive_in_the_mesh_and_classes_take_a_part(tmp_path: Path) -> None:
    points = sphere_points(1000)
    below = np.where(points[:, 2] < 0, 2, 6)
    columns = np.column_stack([points, np.tile([250, 128, 0], (1000, 1)), below])
    header = "x,y,z,red,green,blue,classification"
    np.savetxt(tmp_path / "scan.csv", columns, delimiter=",", header=header, comments="")
    scan, mesh = str(tmp_path / "scan.csv"), str(tmp_path / "mesh.ply")
    assert run(["reconstruct", scan, mesh, "--classes", "2", "--quiet"]) == 0
    made = read_points(mesh)
    assert made.points[:, 2].max() < 0.3
    assert {name: set(made.attributes[name].tolist()) for name in ("red", "green", "blue", "classification")} == {
        "red": {250},
        "green": {128},
        "blue": {0},
        "classification": {2},
    }
    assert run(["reconstruct", scan, mesh, "--classes", "9", "--quiet"]) == 2


def test_a_georeferenced_mesh_replaces_its_own_files(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "scan.xyz", sphere_points(800) + np.array([456_789.25, 5_678_901.5, 123.0]))
    for _ in range(2):
        assert run(["reconstruct", str(tmp_path / "scan.xyz"), str(tmp_path / "mesh.glb"), "--quiet"]) == 0
    assert json.loads((tmp_path / "mesh.glb.world.json").read_text())["shift"][1] == pytest.approx(5_678_901.5, abs=10)
