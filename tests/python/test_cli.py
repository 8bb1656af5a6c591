# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands, with stand-ins for the work behind them."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import standins
import trimesh
from files import WITH_NORMALS
from shapes import sphere

from hdpea.cli import run
from hdpea.reading import read_points

Capture = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def stand_ins(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("hdpea.reconstruction", "hdpea.embedding"):
        monkeypatch.setitem(sys.modules, name, sys.modules.get(name))
    standins.install()


@pytest.fixture
def scan(tmp_path: Path) -> str:
    (tmp_path / "scan.ply").write_bytes(WITH_NORMALS["binary.ply"])
    return str(tmp_path / "scan.ply")


@pytest.fixture
def failed(capsys: Capture) -> Callable[..., str]:
    """Return a function that runs a command and returns its error, having checked its exit code and manners."""

    def failed(exit_code: int, *arguments: str | Path) -> str:
        assert run([str(each) for each in arguments]) == exit_code
        error = capsys.readouterr().err
        assert "Traceback" not in error
        assert sum(line.startswith("Error: ") for line in error.splitlines()) == 1
        return error

    return failed


def test_a_mesh_is_made_and_summed_up(scan: str, tmp_path: Path, capsys: Capture) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj")]) == 0
    assert len(trimesh.load(tmp_path / "mesh.obj", process=False).faces) == 1
    told = capsys.readouterr()
    assert told.out == ""
    assert "reading ..." in told.err
    assert "mesh: 3 vertices, 1 face, manifold, 1 boundary loop" in told.err


def test_quiet_is_silent(scan: str, tmp_path: Path, capsys: Capture) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj"), "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")


def test_the_report_knows_the_flags_and_the_stages(scan: str, tmp_path: Path) -> None:
    arguments = [
        "reconstruct",
        scan,
        str(tmp_path / "mesh.ply"),
        "--vertices",
        "9",
        "--fill-holes",
        "2%",
        "--seed",
        "5",
    ]
    assert run([*arguments, "--report", str(tmp_path / "report.json")]) == 0
    report = json.loads((tmp_path / "report.json").read_text())
    assert report["options"]["meshing"]["vertices"] == 9
    assert report["options"]["meshing"]["fill_holes"] == "2%"
    assert report["options"]["particles"]["seed"] == 5
    assert report["counts"]["points"] == 20
    assert [stage["name"] for stage in report["stages"]] == ["reading", "start-up", "writing"]


def test_what_was_dropped_is_told(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "scan.xyz").write_text("0 0 0\n1 0 0\n0 1 0\n0 0 0\nnan 0 0\n")
    assert run(["reconstruct", str(tmp_path / "scan.xyz"), str(tmp_path / "mesh.obj")]) == 0
    told = capsys.readouterr().err
    assert "NaN or infinite coordinates: 1." in told
    assert "occur twice: 1." in told


@pytest.mark.slow
def test_a_picture_is_drawn(scan: str, tmp_path: Path) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj"), "--picture", str(tmp_path / "mesh.png")]) == 0
    assert (tmp_path / "mesh.png").read_bytes().startswith(b"\x89PNG")


def test_an_embedding_is_written(scan: str, tmp_path: Path) -> None:
    assert run(["embed", scan, str(tmp_path / "points.npz"), "--normals", "estimate"]) == 0
    assert read_points(tmp_path / "points.npz").attributes["coordinates"].shape == (20, 8)


def test_a_missed_target_keeps_the_mesh_but_is_an_error(scan: str, tmp_path: Path, failed: Callable[..., str]) -> None:
    assert "1 hole" in failed(5, "reconstruct", scan, tmp_path / "mesh.obj", "--watertight")
    assert (tmp_path / "mesh.obj").exists()


def test_an_internal_error_is_one_sentence(scan: str, tmp_path: Path, failed: Callable[..., str]) -> None:
    error = failed(1, "reconstruct", scan, tmp_path / "mesh.obj", "--seed", str(standins.FAILING_SEED))
    assert "Internal error: ZeroDivisionError: a bug" in error
    assert not (tmp_path / "mesh.obj").exists()


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
        (["--normals", "guess"], "'guess'"),
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
    [("mesh.docx", ".obj"), ("nowhere/mesh.obj", "no folder"), ("scan.ply", "both input and output")],
)
def test_outputs_that_cannot_be_are_found_at_once(
    output: str, reason: str, scan: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    assert reason in failed(2, "reconstruct", scan, tmp_path / output)


def test_an_unknown_command_is_wrong_usage(failed: Callable[..., str]) -> None:
    assert "reconstrukt" in failed(2, "reconstrukt")


def test_info_says_what_is_in_a_file(scan: str, capsys: Capture) -> None:
    assert run(["info", scan]) == 0
    told = capsys.readouterr().out
    assert "binary little-endian PLY" in told
    assert "20 usable" in told


def test_info_as_json(tmp_path: Path, capsys: Capture) -> None:
    np.save(tmp_path / "scan.npy", 1e7 + sphere(500))
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
