# SPDX-License-Identifier: GPL-3.0-or-later
"""What people are used to from other commands: suggestions, completion, a manual page, a short end."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import click
import numpy as np
import pytest
from helpers import clouds

from hdpea.cli import COMMANDS, hdpea, run
from hdpea.cli.manual import manual

Capture = pytest.CaptureFixture[str]


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        (["reconstrukt"], "'reconstruct'"),
        (["dataset", "bild"], "'build'"),
        (["reconstruct", "a", "--vertises"], "--vertices"),
    ],
)
def test_the_nearest_is_suggested(typed: list[str], meant: str, failed: Callable[..., str]) -> None:
    assert meant in failed(2, *typed)


@pytest.fixture
def scan(tmp_path: Path) -> str:
    np.save(tmp_path / "scan.npy", clouds.sphere(800)[0])
    return str(tmp_path / "scan.npy")


def test_a_run_ends_in_three_lines(scan: str, tmp_path: Path, capsys: Capture) -> None:
    output = tmp_path / "mesh.ply"

    def told(*flags: str) -> list[str]:
        assert run(["reconstruct", scan, str(output), *flags]) == 0
        return capsys.readouterr().err.splitlines()

    last = told()[-3:]
    assert [line.split(":")[0] for line in last[:2]] == ["mesh", "points to mesh"]
    assert last[2].startswith(f"{output}: written")
    assert not any("(one for every 8 points)" in line for line in told())
    assert any("(one for every 8 points)" in line for line in told("--verbose"))


@pytest.mark.parametrize(("vertices", "absurd"), [("5", True), ("100", False)])
def test_a_mesh_that_hardly_shows_the_shape_is_told(
    vertices: str, absurd: bool, scan: str, tmp_path: Path, capsys: Capture
) -> None:
    assert run(["reconstruct", scan, str(tmp_path / "mesh.ply"), "--vertices", vertices]) == 0
    assert ("hardly show the shape" in capsys.readouterr().err) == absurd


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        (["a.stl", "{scan}"], "The cloud comes first, then the mesh: {scan} a.stl"),
        (["a.stl", "{misspelt}"], "The cloud comes first, then the mesh: {scan} a.stl"),
        (["{scan}", "mesh.stl", "watertight"], "it begins with two dashes: --watertight"),
        (["{scan}", "mesh"], "mesh.obj, say"),
        (["{scan}", "mesh."], " mesh.obj, say"),
        (["{scan}", "mesh.gltf"], "mesh.glb, say"),
    ],
)
def test_a_name_that_cannot_be_meant_gets_one_that_can(
    typed: list[str], meant: str, scan: str, failed: Callable[..., str]
) -> None:
    names = {"scan": scan, "misspelt": scan.replace("scan.npy", "scam.npy")}
    assert meant.format(**names) in failed(2, "reconstruct", *(each.format(**names) for each in typed))


def test_an_open_stl_is_told_and_what_else_was_written(scan: str, tmp_path: Path, capsys: Capture) -> None:
    points = np.load(scan)
    np.save(scan, points[points[:, 2] < 0.3])
    more = ["--report", str(tmp_path / "report.json"), "--quiet"]
    for flags, told in (([], "--watertight makes it so"), (["--watertight"], "of the area fills holes")):
        assert run(["reconstruct", scan, str(tmp_path / "mesh.stl"), *more[:2], *flags]) == 0
        lines = capsys.readouterr().err
        assert told in lines
        assert f"Also written: {tmp_path / 'report.json'}" in lines


@pytest.mark.parametrize(
    ("words", "offered"),
    [("hdpea re", "plain,reconstruct"), ("hdpea reconstruct --out", "plain,--out-dir"), ("hdpea info sc", "file,sc")],
)
def test_shells_complete(words: str, offered: str) -> None:
    position = str(len(words.split()) - 1)
    asked = {**os.environ, "_HDPEA_COMPLETE": "bash_complete", "COMP_WORDS": words, "COMP_CWORD": position}
    ran = subprocess.run([sys.executable, "-m", "hdpea"], env=asked, capture_output=True, text=True, check=True)
    assert offered in ran.stdout.splitlines()


def test_the_manual_has_every_command_and_flag_and_no_stray_requests() -> None:
    page = manual(hdpea, click.Context(hdpea, info_name="hdpea"), "1.0")
    lines = page.replace(r"\-", "-").splitlines()
    for name in COMMANDS:
        assert any(line.startswith(f'.SS "hdpea {name} ') for line in lines)
    command = hdpea.get_command(click.Context(hdpea), "reconstruct")
    assert command is not None
    for option in (each for each in command.params if isinstance(each, click.Option)):
        assert any(line.startswith(rf"\fB{option.opts[0]}") for line in lines)
    requests = {line.split()[0] for line in lines if line.startswith((".", "'"))}
    assert requests == {".TH", ".SH", ".SS", ".TP", ".PP", ".nf", ".fi"}
