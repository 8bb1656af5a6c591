# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands, their flags and their outputs; stand-ins where a test needs the work to go wrong."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from helpers import clouds, standins
from helpers.clouds import sphere_points
from helpers.files import WITH_NORMALS

from hdpea.cli import run
from hdpea.cli.parameters import with_flags
from hdpea.reading import read_points
from hdpea.reconstruction import PHASES
from hdpea.writing.meshes import MESH_FORMATS

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def stand_ins(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("hdpea.reconstruction", "hdpea.embedding"):
        monkeypatch.setitem(sys.modules, name, sys.modules.get(name))
    standins.install()


@pytest.fixture
def scan(tmp_path: Path) -> str:
    np.savetxt(tmp_path / "scan.xyz", np.hstack(clouds.torus(800)))
    return str(tmp_path / "scan.xyz")


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
    *before, repair, measuring = PHASES
    expected = ["reading", "start-up", *before, "refinement", repair, measuring, "writing"]
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
    assert run(["embed", scan, str(tmp_path / "points.npz"), "--normals", "estimate"]) == 0
    written = read_points(tmp_path / "points.npz")
    assert written.attributes["coordinates"].shape == (800, 8)
    np.testing.assert_allclose(written.points, clouds.torus(800)[0])
    told = capsys.readouterr().err
    assert "bending_length: " in told
    assert "normal_neighbors: 16 points" in told


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


@pytest.mark.parametrize("command", ["reconstruct", "embed"])
def test_an_output_never_takes_the_place_of_its_input(command: str, tmp_path: Path, failed: Callable[..., str]) -> None:
    (tmp_path / "scan.ply").write_bytes(WITH_NORMALS["binary.ply"])
    assert "both input and output" in failed(2, command, tmp_path / "scan.ply", tmp_path / "scan.ply")
    assert (tmp_path / "scan.ply").read_bytes() == WITH_NORMALS["binary.ply"]


@pytest.mark.parametrize("flag", ["--report", "--config"])
def test_no_other_file_of_a_run_takes_the_place_of_an_input(
    flag: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    source = tmp_path / "in.json"
    source.write_text("vertices = 100\n" if flag == "--config" else "1 2 3\n")
    other = {"--report": [source, tmp_path / "mesh.obj"], "--config": [tmp_path / "scan.xyz", tmp_path / "mesh.obj"]}
    flags = ["--report", source, *(["--config", source] if flag == "--config" else [])]
    assert "both input and output" in failed(2, "reconstruct", *other[flag], *flags)
    assert source.stat().st_size > 5


def test_two_outputs_are_two_files(scan: str, tmp_path: Path, failed: Callable[..., str]) -> None:
    (tmp_path / "soft.html").symlink_to(tmp_path / "mesh.ply")
    assert "same output" in failed(
        2, "curvature", scan, tmp_path / "mesh.ply", "--page", tmp_path / "soft.html", "--quiet"
    )


def test_errors_of_the_library_name_flags_where_they_come_from_a_command(
    scan: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    told = failed(2, "reconstruct", scan, tmp_path / "m.obj", "--weights", "w")
    assert "Hint: Give --embedding learned as well." in told
    assert "--vertices is at least 4" in failed(2, "reconstruct", scan, tmp_path / "m.obj", "--vertices", "3")


def test_flags_take_the_place_of_options_in_a_text() -> None:
    flags = {"orient": "--orient", "refine": "--refine", "metric_scale": "--metric-scale"}
    told = with_flags("Use `orient='auto'`, `refine=False`, `refine=True` or a `metric_scale`, not `points`.", flags)
    assert told == "Use --orient auto, --no-refine, --refine or a --metric-scale, not `points`."


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


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--vertices", "9", "--faces", "9"], "exclude"),
        (["--vertices", "3"], "at least 4"),
        (["--vertices", "many"], "not a valid integer"),
        (["--fill-holes", "wide"], "not a length"),
        (["--fill-holes", "-1%"], "cannot be -1"),
        (["--error", "small"], "not a length"),
        (["--error", "0"], "No mesh of fewer triangles has an --error of 0"),
        (["--normals", "guess"], "'guess'"),
        (["--orient", "guess"], "'guess'"),
        (["--orient", "viewpoint"], "no viewpoint"),
        (["--orient", "viewpoint", "--viewpoint", "up"], "not a position"),
        (["--vertices", "1" + 30 * "0"], "at most"),
        (["--max-stretch", "inf"], "--max-stretch is a number"),
        (["--report", f"{'a' * 300}.json"], "too long"),
        (["--viewpoint", "1,2,3"], "of no use with orient auto"),
        (["--vertises", "9"], "--vertices"),
        (["--report", "report.txt"], ".json"),
        (["--picture", "picture.jpg"], ".png"),
        (["--report", "nowhere/report.json"], "no folder nowhere"),
    ],
)
def test_wrong_usage_is_found_at_once(
    arguments: list[str], reason: str, scan: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    assert reason in failed(2, "reconstruct", scan, tmp_path / "mesh.obj", *arguments)
    assert not (tmp_path / "mesh.obj").exists()


@pytest.mark.parametrize(
    ("output", "reason"),
    [
        ("mesh.docx", ".obj"),
        ("nowhere/mesh.obj", "no folder"),
        ("/proc/mesh.obj", "in /proc"),  # where not even root may write
    ],
)
def test_outputs_that_cannot_be_are_found_at_once(
    output: str, reason: str, scan: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    assert reason in failed(2, "reconstruct", scan, tmp_path / output)


@pytest.fixture
def scan_with_strays(tmp_path: Path) -> str:
    np.save(tmp_path / "strays.npy", np.vstack([clouds.torus(800)[0], [[9.0, 0.0, 0.0], [0.0, 7.0, 0.0]]]))
    return str(tmp_path / "strays.npy")


@pytest.mark.parametrize("name", ["dropped.ply", "dropped.npz"])
def test_what_was_dropped_is_written_with_the_reason(name: str, scan_with_strays: str, tmp_path: Path) -> None:
    assert run(["reconstruct", scan_with_strays, str(tmp_path / "m.obj"), "--dropped", str(tmp_path / name)]) == 0
    dropped = read_points(tmp_path / name)
    assert [9, 0, 0] in dropped.points.tolist()
    assert [0, 7, 0] in dropped.points.tolist()
    assert set(dropped.attributes["reason"].tolist()) == {1}


def test_a_file_of_dropped_points_may_be_empty(scan: str, tmp_path: Path) -> None:
    arguments = ["reconstruct", scan, str(tmp_path / "m.obj"), "--outliers", "none"]
    assert run([*arguments, "--dropped", str(tmp_path / "dropped.ply")]) == 0
    assert b"element vertex 0" in (tmp_path / "dropped.ply").read_bytes()


def test_dropped_points_never_take_the_place_of_the_input(
    scan_with_strays: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    (tmp_path / "soft.npz").symlink_to(scan_with_strays)
    command = ["reconstruct", scan_with_strays, tmp_path / "m.obj", "--dropped"]
    assert "both input and output" in failed(2, *command, tmp_path / "soft.npz")
    assert "not one of .npz, .ply" in failed(2, *command, tmp_path / "dropped.xyz")


@pytest.mark.parametrize("command", ["embed", "curvature"])
def test_other_commands_leave_strays_out_and_say_so(
    command: str, scan_with_strays: str, tmp_path: Path, capsys: Capture
) -> None:
    def written(*flags: str) -> int:
        assert run([command, scan_with_strays, str(tmp_path / "out.npz"), *flags]) == 0
        return len(np.load(tmp_path / "out.npz")["points"])

    assert written() <= 800
    assert "lie on no surface" in capsys.readouterr().err
    assert written("--outliers", "none") == 802
    assert "lie on no surface" not in capsys.readouterr().err


def test_an_unknown_command_is_wrong_usage(failed: Callable[..., str]) -> None:
    assert "reconstrukt" in failed(2, "reconstrukt")


def test_info_says_what_is_in_a_file(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "scan.ply").write_bytes(WITH_NORMALS["binary.ply"])
    assert run(["info", str(tmp_path / "scan.ply")]) == 0
    told = capsys.readouterr().out
    assert "binary little-endian PLY" in told
    assert "20 usable" in told


@pytest.mark.parametrize(("sign", "fate"), [(1.0, "will be kept"), (-1.0, "oriented anew")])
def test_info_says_what_becomes_of_the_normals(sign: float, fate: str, tmp_path: Path, capsys: Capture) -> None:
    points, normals = clouds.torus(800)
    normals[::2] *= sign
    np.savetxt(tmp_path / "scan.xyz", np.hstack([points, normals]))
    assert run(["info", str(tmp_path / "scan.xyz")]) == 0
    assert fate in capsys.readouterr().out


def test_info_tells_directions_that_are_no_normals(tmp_path: Path, capsys: Capture) -> None:
    points, normals = clouds.torus(800)
    np.savetxt(tmp_path / "scan.xyz", np.hstack([points, np.random.default_rng(0).permutation(normals)]))
    assert run(["info", str(tmp_path / "scan.xyz")]) == 0
    assert "do not lie across the surface" in capsys.readouterr().out


def test_info_says_what_a_run_would_leave_out(scan_with_strays: str, capsys: Capture) -> None:
    assert run(["info", scan_with_strays]) == 0
    told = capsys.readouterr().out
    assert "along the surface" in told
    assert "lie on no surface" in told


def test_info_says_that_points_are_too_few(tmp_path: Path, capsys: Capture) -> None:
    np.savetxt(tmp_path / "scan.xyz", sphere_points(15))
    assert run(["info", str(tmp_path / "scan.xyz")]) == 0
    assert "a run needs at least 16 points" in capsys.readouterr().out


def test_info_as_json(tmp_path: Path, capsys: Capture) -> None:
    np.save(tmp_path / "scan.npy", 1e7 + sphere_points(500))
    assert run(["info", str(tmp_path / "scan.npy"), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["counts"]["points"] == 500
    assert facts["diagonal"] == pytest.approx(12**0.5, rel=0.05)
    assert 0.02 < facts["spacing"] < 0.1
    assert facts["estimated_seconds"] > 0


def test_info_of_a_single_point(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "scan.xyz").write_text("1 2 3\n")
    assert run(["info", str(tmp_path / "scan.xyz")]) == 0
    assert "unknown" in capsys.readouterr().out


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


def test_the_file_that_says_where_a_mesh_lies_takes_no_others_place(scan: str, tmp_path: Path) -> None:
    beside = str(tmp_path / "mesh.glb.world.json")
    assert run(["reconstruct", scan, str(tmp_path / "mesh.glb"), "--report", beside]) == 2


def test_a_georeferenced_mesh_replaces_its_own_files(tmp_path: Path) -> None:
    np.savetxt(tmp_path / "scan.xyz", sphere_points(800) + np.array([456_789.25, 5_678_901.5, 123.0]))
    for _ in range(2):
        assert run(["reconstruct", str(tmp_path / "scan.xyz"), str(tmp_path / "mesh.glb"), "--quiet"]) == 0
    assert json.loads((tmp_path / "mesh.glb.world.json").read_text())["shift"][1] == pytest.approx(5_678_901.5, abs=10)


def test_a_texture_wants_a_format_that_holds_it_and_names_for_its_files(
    scan: str, tmp_path: Path, capsys: Capture
) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.ply"), "--texture", "256"]) == 2
    assert "PLY holds no --texture" in capsys.readouterr().err
    assert run(["reconstruct", scan, "-", "--format", "obj", "--texture", "256"]) == 2
    picture = str(tmp_path / "mesh.texture.png")
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj"), "--texture", "256", "--picture", picture]) == 2
    assert "same output" in capsys.readouterr().err
