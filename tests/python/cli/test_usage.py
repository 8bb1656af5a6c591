# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrong usage is found before the work, in a sentence that names the flag, and costs no file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from helpers.files import WITH_NORMALS

from hdpea.cli import run
from hdpea.cli.groups import with_flags

Capture = pytest.CaptureFixture[str]


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


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["--vertices", "9", "--faces", "9"], "exclude"),
        (["--vertices", "3"], "at least 4"),
        (["--vertices", "many"], "not a whole number such as 5000"),
        (["--vertices", "1,200"], "not a whole number such as 1200"),
        (["--vertices"], "`hdpea reconstruct --help` explains"),
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


@pytest.mark.parametrize("command", ["reconstruct", "embed", "curvature"])
def test_an_output_has_a_name(command: str, scan: str, failed: Callable[..., str]) -> None:
    assert "a name is missing" in failed(2, command, scan, "")


@pytest.mark.parametrize(
    ("output", "reason"),
    [
        ("mesh.docx", ".obj"),
        ("nowhere/mesh.obj", "no folder"),
        ("scan.xyz/mesh.obj", "scan.xyz is no folder"),
        ("/proc/mesh.obj", "in /proc"),  # where not even root may write
    ],
)
def test_outputs_that_cannot_be_are_found_at_once(
    output: str, reason: str, scan: str, tmp_path: Path, failed: Callable[..., str]
) -> None:
    assert reason in failed(2, "reconstruct", scan, tmp_path / output)


def test_an_unknown_command_is_wrong_usage(failed: Callable[..., str]) -> None:
    assert "reconstrukt" in failed(2, "reconstrukt")


def test_the_file_that_says_where_a_mesh_lies_takes_no_others_place(scan: str, tmp_path: Path) -> None:
    beside = str(tmp_path / "mesh.glb.world.json")
    assert run(["reconstruct", scan, str(tmp_path / "mesh.glb"), "--report", beside]) == 2


def test_a_texture_wants_a_format_that_holds_it_and_names_for_its_files(
    scan: str, tmp_path: Path, capsys: Capture
) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.ply"), "--texture", "256"]) == 2
    assert "PLY holds no --texture" in capsys.readouterr().err
    assert run(["reconstruct", scan, "-", "--format", "obj", "--texture", "256"]) == 2
    picture = str(tmp_path / "mesh.texture.png")
    assert run(["reconstruct", scan, str(tmp_path / "mesh.obj"), "--texture", "256", "--picture", picture]) == 2
    assert "same output" in capsys.readouterr().err


def test_an_option_with_one_dash_is_recognised(scan: str, failed: Callable[..., str]) -> None:
    assert "Did you mean '--watertight'" in failed(2, "reconstruct", scan, "-watertight")
