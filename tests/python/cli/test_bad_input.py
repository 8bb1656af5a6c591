# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input through the whole command: a sentence, a hint, the right exit code, and nothing half-written."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from helpers import clouds
from helpers.files import WITH_NORMALS, ply

from hdpea.cli import run
from hdpea.reading import read_points

Capture = pytest.CaptureFixture[str]
Reconstruct = Callable[..., tuple[str, dict[str, Any]]]


def scan(rows: clouds.Array) -> bytes:
    return "".join(" ".join(map(repr, row)) + "\n" for row in rows.tolist()).encode()


@pytest.fixture
def reconstruct(tmp_path: Path, capsys: Capture) -> Reconstruct:
    """Return a function from the content of a file (None: no file) and flags to what is told and reported.

    It checks the exit code and the manners: no traceback, one error with a hint, and after an error no file
    but the input.
    """

    def reconstruct(exit_code: int, content: bytes | None, *flags: str, name: str = "scan.xyz") -> Any:
        before = {"mesh.ply"} if "mesh.ply" in {each.name for each in tmp_path.iterdir()} else set()
        if content is not None:
            (tmp_path / name).write_bytes(content)
            before.add(name)
        outputs = [str(tmp_path / "mesh.ply"), "--report", str(tmp_path / "report.json")]
        assert run(["reconstruct", str(tmp_path / name), *outputs, *flags]) == exit_code
        out, told = capsys.readouterr()
        assert out == ""
        assert "Traceback" not in told
        errors = [line for line in told.splitlines() if line.startswith("Error: ")]
        hints = [line for line in told.splitlines() if line.startswith("Hint: ")]
        if exit_code:
            assert (len(errors), len(hints)) == (1, 1)
            assert {each.name for each in tmp_path.iterdir()} == before
            return told, {}
        assert errors == hints == []
        return told, json.loads((tmp_path / "report.json").read_text())

    return reconstruct


def sphere(count: int = 500) -> clouds.Array:
    return clouds.sphere(count)[0]


@pytest.mark.parametrize(
    ("content", "name", "reason"),
    [
        (None, "scan.ply", "no file"),
        (b"", "scan.ply", "empty"),
        (ply()[:-100], "scan.ply", "ends after 17 of its 20 points"),
        (WITH_NORMALS["named.npz"][:-30], "scan.npz", "damaged"),
        (b"1 2 3\n4 five 6\n", "scan.xyz", "line 2 reads '4 five 6'"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "scan.ply", "format is unknown"),
        (b"LASF" + bytes(100), "scan.las", "LAS"),
        (b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", "scan.ply", "no points"),
        (b"nan nan nan\n" * 30, "scan.xyz", "finite"),
    ],
)
def test_what_cannot_be_read(content: bytes | None, name: str, reason: str, reconstruct: Reconstruct) -> None:
    assert reason in reconstruct(3, content, name=name)[0]


@pytest.mark.parametrize(
    ("rows", "reason"),
    [
        (sphere(15), "15 distinct points are too few"),
        (np.ones((100, 3)), "All points are equal"),
        (np.linspace(0, 1, 100)[:, None] * [1.0, 2.0, 3.0], "on a line"),
        (1e7 + np.linspace(0, 1, 100)[:, None] * [1.0, 2.0, 3.0], "on a line"),
        (np.vstack([sphere(10)] * 10), "10 distinct points are too few"),
    ],
)
def test_what_holds_no_surface(rows: clouds.Array, reason: str, reconstruct: Reconstruct) -> None:
    assert reason in reconstruct(4, scan(rows))[0]


def test_points_that_are_not_finite_are_dropped_and_counted(reconstruct: Reconstruct) -> None:
    dirty = np.vstack([sphere(), [[np.nan, 0, 0], [0, np.inf, 0], [0, 0, -np.inf]]])
    told, report = reconstruct(0, scan(dirty))
    assert "NaN or infinite coordinates: 3." in told
    assert (report["counts"]["points"], report["counts"]["dropped_non_finite"]) == (500, 3)
    assert report["mesh"]["closed"]


def test_duplicates_are_dropped_and_counted(reconstruct: Reconstruct) -> None:
    told, report = reconstruct(0, scan(np.vstack([sphere(), sphere()[:77]])))
    assert "occur twice: 77." in told
    assert (report["counts"]["points"], report["counts"]["dropped_duplicates"]) == (500, 77)
    assert report["mesh"]["closed"]


def test_a_plane_reconstructs(reconstruct: Reconstruct, tmp_path: Path) -> None:
    report = reconstruct(0, scan(clouds.plane(500)[0]))[1]
    assert (report["mesh"]["components"], report["mesh"]["boundary_loops"]) == (1, 1)
    assert abs(read_points(tmp_path / "mesh.ply").points[:, 2]).max() < 1e-12
    assert report["distances"]["in_spacings"]["max"] < 1  # of points beyond the border


def test_millimetres_at_ten_million_metres_survive(reconstruct: Reconstruct, tmp_path: Path) -> None:
    small = 0.1 * sphere(1000)  # spacings of a few millimetres
    here = reconstruct(0, scan(small))[1]
    near = read_points(tmp_path / "mesh.ply").points
    there = reconstruct(0, scan(1e7 + small))[1]
    far = read_points(tmp_path / "mesh.ply").points
    assert there["mesh"] == here["mesh"]
    # A double at 1e7 has steps of 2e-9.
    assert abs(far - 1e7 - near).max() < 1e-6
    assert there["distances"]["in_world_units"]["rms"] == pytest.approx(
        here["distances"]["in_world_units"]["rms"], rel=1e-3
    )


def test_zero_normals_are_estimated(reconstruct: Reconstruct, tmp_path: Path) -> None:
    told, report = reconstruct(0, scan(np.hstack([sphere(), np.zeros((500, 3))])))
    assert "Normals that are zero or not finite, to be estimated: 500." in told
    assert report["counts"]["normals_estimated"] == 500
    with_zeros = (tmp_path / "mesh.ply").read_bytes()
    reconstruct(0, scan(sphere()))
    assert (tmp_path / "mesh.ply").read_bytes() == with_zeros


def test_insisting_on_normals_that_are_zero(reconstruct: Reconstruct) -> None:
    rows = np.hstack([sphere(), clouds.sphere(500)[1]])
    rows[::9, 3:] = 0
    assert "56 points have no usable normal" in reconstruct(3, scan(rows), "--normals", "file")[0]


@pytest.mark.parametrize("flags", [["--vertices", "501"], ["--faces", "2000"]])
def test_more_vertices_than_points(flags: list[str], reconstruct: Reconstruct) -> None:
    assert "there are 500 distinct points" in reconstruct(2, scan(sphere()), *flags)[0]


@pytest.mark.parametrize("flags", [["--metric-scale", "0"], ["--curvature-radius", "0"], ["--vertices", "0"]])
def test_numbers_without_sense(flags: list[str], reconstruct: Reconstruct) -> None:
    reconstruct(2, scan(sphere()), *flags)


def test_a_failed_run_leaves_the_mesh_of_the_last_one(reconstruct: Reconstruct, tmp_path: Path) -> None:
    reconstruct(0, scan(sphere()))
    (tmp_path / "report.json").unlink()
    before = (tmp_path / "mesh.ply").read_bytes()
    reconstruct(4, scan(np.ones((100, 3))))
    assert (tmp_path / "mesh.ply").read_bytes() == before


def test_the_mesh_has_what_was_asked(reconstruct: Reconstruct) -> None:
    report = reconstruct(0, scan(sphere()), "--vertices", "100", "--seed", "3")[1]
    assert report["mesh"]["vertices"] == 100
    assert report["options"]["particles"]["seed"] == 3
    assert "start-up" in {stage["name"] for stage in report["stages"]}
