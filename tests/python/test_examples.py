# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples run as they are."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from hdpea.cli import run as command
from hdpea.reading import read_points

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(script: str, *arguments: object) -> str:
    line = [sys.executable, str(EXAMPLES / script), *map(str, arguments)]
    return subprocess.run(line, check=True, capture_output=True, text=True).stdout


@pytest.mark.slow
def test_a_shape_becomes_a_scan_becomes_a_mesh(tmp_path: Path) -> None:
    scan, mesh = tmp_path / "cone.ply", tmp_path / "cone.obj"
    run("shapes.py", "cone", scan, "--points", 3_000)
    assert len(read_points(scan).points) == 3_000
    assert "3000 points -> 375 vertices" in run("reconstruct_a_scan.py", scan, mesh)
    assert {each.suffix for each in tmp_path.iterdir()} == {".ply", ".obj", ".json", ".png"}
    assert command(["reconstruct", str(scan), str(tmp_path / "same.obj"), "--quiet"]) == 0
    assert (tmp_path / "same.obj").read_bytes() == mesh.read_bytes()


@pytest.mark.slow
def test_the_stages_by_hand_make_a_mesh(tmp_path: Path) -> None:
    assert "2000 faces" in run("stages_by_hand.py", tmp_path / "torus.obj")
    assert len(read_points(tmp_path / "torus.obj").points) == 1_000


@pytest.mark.slow
def test_a_scan_is_coloured_by_curvature(tmp_path: Path) -> None:
    scan, colored = tmp_path / "torus.ply", tmp_path / "colored.ply"
    run("shapes.py", "torus", scan, "--points", 3_000)
    assert "3000 of 3000 points" in run("curvature_of_a_scan.py", scan, colored)
    assert {"red", "green", "blue", "curvature"} <= set(read_points(colored).attributes)
    assert colored.with_suffix(".html").exists()
