# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea evaluate``: what it reads, says and refuses."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from hdpea.cli import run
from hdpea.reading.triangle_mesh import read_triangle_mesh

Capture = pytest.CaptureFixture[str]
Failed = Callable[..., str]

FEW = ("--samples", "2000")


@pytest.fixture
def truth(tmp_path: Path) -> Path:
    trimesh.creation.icosphere(3).export(tmp_path / "truth.ply")
    return tmp_path / "truth.ply"


@pytest.fixture
def result(tmp_path: Path) -> Path:
    trimesh.creation.icosphere(2).export(tmp_path / "result.obj")
    return tmp_path / "result.obj"


def scores(capsys: Capture, *arguments: str | Path) -> dict[str, Any]:
    assert run(["evaluate", *map(str, arguments), *FEW, "--json"]) == 0
    told: dict[str, Any] = json.loads(capsys.readouterr().out)
    assert list(told["files"].values()) == [str(each) for each in arguments[:2]]
    return told


def test_the_table_names_both_normalisations_and_every_score(result: Path, truth: Path, capsys: Capture) -> None:
    assert run(["evaluate", str(result), str(truth), *FEW]) == 0
    told = capsys.readouterr().out
    assert "162 vertices, 320 faces, manifold, watertight, 1 component, 0 self-intersections, genus 0" in told
    assert "longest side = 1" in told
    assert "diagonal = 1" in told
    assert "F1 within 0.003 / 0.004" in told
    assert "between 2,000 samples of each (in brackets the floor)" in told
    for score in ("CD, chamfer", "NC, normal", "HD, Hausdorff", "result to truth, max", "G, under", "largest angle"):
        assert score in told


def test_json_says_the_same_unscaled(result: Path, truth: Path, capsys: Capture) -> None:
    told = scores(capsys, result, truth, "--seed", "3")
    assert told["options"] == {"samples": 2000, "seed": 3}
    assert (told["truth"], told["truth_points"]) == ("mesh", 2000)
    assert told["topology"]["watertight"] is True
    longest, diagonal = (told["accuracy"][name] for name in ("longest_side", "diagonal"))
    assert (longest["f1_threshold"], diagonal["f1_threshold"]) == (0.003, 0.004)
    assert (longest["unit"], diagonal["unit"]) == (pytest.approx(2), pytest.approx(2 * 3**0.5))
    # Vertices of the finer sphere lie above the middles of the coarser one's edges, most above the longest.
    mesh = trimesh.load(result, process=False)
    depth = 1 - np.linalg.norm(mesh.vertices[mesh.edges_unique].mean(axis=1), axis=1).min()
    assert longest["to_result"]["max"] == pytest.approx(depth / 2, rel=0.01)
    assert longest["hausdorff"] == max(longest["to_result"]["max"], longest["to_truth"]["max"])


def test_the_truth_may_be_points_of_any_format(result: Path, tmp_path: Path, capsys: Capture) -> None:
    ball = trimesh.creation.icosphere(4)
    np.savetxt(tmp_path / "points.xyz", ball.vertices)
    (tmp_path / "points.ply").write_bytes(trimesh.PointCloud(ball.vertices).export(file_type="ply"))
    for name in ("points.xyz", "points.ply"):
        told = scores(capsys, result, tmp_path / name)
        assert (told["truth"], told["truth_points"]) == ("points", len(ball.vertices))
        assert told["triangles"]["g"] is None
        assert told["accuracy"]["diagonal"]["to_truth"] is None
    assert run(["evaluate", str(result), str(tmp_path / "points.xyz"), *FEW]) == 0
    assert "between 2,000 samples of the result and the 2,562 points of the truth" in capsys.readouterr().out


def test_formats_without_shared_vertices_are_joined(tmp_path: Path, truth: Path, capsys: Capture) -> None:
    trimesh.creation.icosphere(2).export(tmp_path / "result.stl")
    assert scores(capsys, tmp_path / "result.stl", truth)["topology"]["vertices"] == 162


def test_vertices_that_a_file_keeps_apart_stay_apart(tmp_path: Path) -> None:
    corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv -1 0 0\nv 0 -1 0\nv 1 1 0\nv 9 9 9\n"
    (tmp_path / "two.obj").write_text(corners + "f 1 2 7 3\nf 4 5 6\n")
    vertices, faces = read_triangle_mesh(tmp_path / "two.obj")
    assert vertices.shape == (7, 3)  # the one without a face is left out
    assert faces.shape == (3, 3)


def test_what_cannot_be_measured_is_told(result: Path, truth: Path, tmp_path: Path, failed: Failed) -> None:
    np.savetxt(tmp_path / "points.xyz", np.zeros((5, 3)))
    (tmp_path / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    (tmp_path / "wrong.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")
    (tmp_path / "damaged.ply").write_bytes(truth.read_bytes()[:500])
    assert "no file" in failed(3, "evaluate", tmp_path / "absent.obj", truth)
    assert "no file" in failed(3, "evaluate", result, tmp_path / "absent.ply")
    assert "extension '.xyz' is unknown" in failed(3, "evaluate", tmp_path / "points.xyz", truth)
    assert "no mesh, or damaged" in failed(3, "evaluate", tmp_path / "wrong.off", truth)
    assert "damaged" in failed(3, "evaluate", result, tmp_path / "damaged.ply")
    assert "no area" in failed(4, "evaluate", tmp_path / "flat.obj", truth)
    assert "equal" in failed(4, "evaluate", result, tmp_path / "points.xyz")
    assert "samples is at least 1" in failed(2, "evaluate", result, truth, "--samples", "0")
