# SPDX-License-Identifier: GPL-3.0-or-later
"""What ``hdpea info`` says of a file."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from helpers import clouds
from helpers.clouds import sphere_points
from helpers.files import WITH_NORMALS

from hdpea.cli import run
from hdpea.cli.info import crs_name
from hdpea.cli.needs import InTiles, needs
from hdpea.cli.tiles import Resources
from hdpea.options import Options
from hdpea.reading.cloud import PointCloud
from hdpea.report.inspection import inspect
from hdpea.tiling.run import Tiling, process_bytes

Capture = pytest.CaptureFixture[str]


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


@pytest.mark.parametrize("command", ["info", "embed", "curvature"])
def test_notes_name_flags(command: str, tmp_path: Path, capsys: Capture) -> None:
    sphere = sphere_points(4000)
    np.savetxt(tmp_path / "room.xyz", sphere / (abs(sphere) / [6, 5, 2]).max(axis=1, keepdims=True))
    output = [] if command == "info" else [str(tmp_path / "out.npz" if command == "embed" else tmp_path / "out.ply")]
    assert run([command, str(tmp_path / "room.xyz"), *output]) == 0
    told = capsys.readouterr()
    assert "say so: --orient viewpoint, --viewpoint 0,0,0." in told.out + told.err


def test_info_says_that_points_are_too_few(tmp_path: Path, capsys: Capture) -> None:
    np.savetxt(tmp_path / "scan.xyz", sphere_points(15))
    assert run(["info", str(tmp_path / "scan.xyz")]) == 0
    assert "a run needs at least 16 points" in capsys.readouterr().out


def test_info_of_some_classes_in_little_memory(tmp_path: Path, capsys: Capture) -> None:
    points = sphere_points(600)
    classes = np.repeat([[2.0], [5.0]], 300, axis=0)
    np.savetxt(tmp_path / "scan.csv", np.hstack([points, classes]), delimiter=",", header="x,y,z,classification")
    asked = ["info", str(tmp_path / "scan.csv"), "--classes", "2"]
    assert run(asked) == 0
    told = capsys.readouterr().out
    assert "300 of 600 points" in told
    assert "in one piece" not in told
    assert run([*asked, "--memory", "100MB"]) == 0
    assert "in one piece" in capsys.readouterr().out


def test_info_as_json(tmp_path: Path, capsys: Capture) -> None:
    np.save(tmp_path / "scan.npy", 1e7 + sphere_points(500))
    assert run(["info", str(tmp_path / "scan.npy"), "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["counts"]["points"] == 500
    assert facts["diagonal"] == pytest.approx(12**0.5, rel=0.05)
    assert 0.02 < facts["spacing"] < 0.1
    assert facts["estimated_seconds"] > 0
    assert facts["in_tiles"] is None


@pytest.mark.parametrize(("memory", "jobs"), [(2e9, 1), (8e9, 2)])
def test_what_tiles_need_fits_into_the_memory(memory: float, jobs: int) -> None:
    facts = inspect(PointCloud(sphere_points(500), None, {}))
    large = replace(facts, counts={**facts.counts, "points": 10**7}, default_vertices=10**5, estimated_peak_bytes=25e9)
    resources = Resources(memory)
    tiled = InTiles.of(large, resources)
    assert InTiles.needed(large, resources)
    assert not InTiles.needed(facts, resources)
    assert tiled is not None
    assert tiled.jobs == jobs
    assert jobs * tiled.process_bytes < memory
    # As many processes are planned as have room by the figure that is told.
    per_vertex = 10**7 / 10**5
    assert tiled.process_bytes == process_bytes(Tiling(Path(), memory).sizes(Options(), 10**7)[0], per_vertex)


def test_tiles_are_needed_by_the_most_that_is_told() -> None:
    facts = replace(inspect(PointCloud(sphere_points(500), None, {})), estimated_peak_bytes=1e9)
    assert "up to 1.4, since normals" in needs(facts, Resources(2e9))
    assert InTiles.needed(facts, Resources(1.3e9))
    assert not InTiles.needed(facts, Resources(1.5e9))


def test_info_of_a_single_point(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "scan.xyz").write_text("1 2 3\n")
    assert run(["info", str(tmp_path / "scan.xyz")]) == 0
    assert "unknown" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("crs", "told"),
    [
        (None, "not told by the file"),
        ("EPSG:25832", "EPSG:25832"),
        ('PROJCRS["ETRS89 / UTM zone 32N",BASEGEOGCRS["ETRS89",ID["EPSG",4258]],ID["EPSG",25832]]', "25832)"),
        ('PROJCS["ETRS89 / UTM zone 32N",UNIT["metre",1],AUTHORITY["EPSG","25832"]]', "25832)"),
        ('LOCAL_CS["site grid",UNIT["metre",1,ID["EPSG",9001]]]', "site grid"),
    ],
)
def test_a_reference_system_is_told_by_its_name(crs: str | None, told: str) -> None:
    named = "ETRS89 / UTM zone 32N (EPSG:" if told == "25832)" else ""
    assert crs_name(crs) == named + told
