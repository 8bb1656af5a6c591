# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea benchmark``: whole suites on tiny meshes, and the methods themselves."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import trimesh
from helpers.networks import TINY, network_of

from hdpea.benchmark.clouds import make_cloud
from hdpea.benchmark.methods import Cloud, method_options
from hdpea.benchmark.run import evenly
from hdpea.benchmark.suite import SuiteInput
from hdpea.benchmark.worker import Task, run_method
from hdpea.cli import run
from hdpea.dataset.options import DegradationOptions, SampleOptions, ScanOptions
from hdpea.errors import UsageError
from hdpea.geometry.triangles import TriangleMesh
from hdpea.network.weights import write_weights
from hdpea.reading import read_points

Capture = pytest.CaptureFixture[str]
Failed = Callable[..., str]

SUITE = """
title = "meshes made elsewhere"
meshes = "meshes"
points = 500
samples = 1000
vertices = 42
pictures = 0

[[input]]
name = "clean"

[[method]]
name = "coarse"
method = "folder"
path = "{folder}/{{model}}.ply"
"""


def ball(radius: float = 1.0, subdivisions: int = 3) -> TriangleMesh:
    mesh = trimesh.creation.icosphere(subdivisions, radius)
    return np.asarray(mesh.vertices), np.asarray(mesh.faces)


@pytest.fixture
def suite(tmp_path: Path) -> Path:
    for number, name in enumerate(("big", "small")):
        trimesh.creation.icosphere(3, 2 - number).export(_parent(tmp_path / "meshes" / f"{name}.ply"))
        trimesh.creation.icosphere(1, 2 - number).export(_parent(tmp_path / "made" / f"{name}.ply"))
    (tmp_path / "suite.toml").write_text(SUITE.format(folder=tmp_path / "made"))
    return tmp_path / "suite.toml"


def _parent(path: Path) -> Path:
    path.parent.mkdir(exist_ok=True)
    return path


def told(capsys: Capture) -> list[str]:
    return capsys.readouterr().err.splitlines()


def test_a_suite_is_run_and_continued(suite: Path, tmp_path: Path, capsys: Capture) -> None:
    out = tmp_path / "out"
    arguments = ["benchmark", str(suite), str(out)]
    assert run(arguments) == 0
    first, second, last = told(capsys)
    assert re.match(r"\[1 of 2\] clean/big/coarse@42: 42 vertices, rms \d\.\d+ % of the longest side", first)
    assert last.endswith("index.html: 2 runs, 0 failed")
    assert {each.name for each in out.iterdir()} == {
        "clouds",
        "meshes",
        "runs",
        "results.csv",
        "results.md",
        "index.html",
    }
    assert read_points(out / "clouds" / "clean" / "small.ply").points.shape == (500, 3)
    assert "| coarse | 2/2 | 42 |" in (out / "results.md").read_text()
    assert "meshes made elsewhere" in (out / "index.html").read_text()

    before = (out / "results.csv").read_bytes()
    assert run(arguments) == 0
    assert all("is there already" in line for line in told(capsys)[:-1])
    assert (out / "results.csv").read_bytes() == before

    trimesh.creation.icosphere(2, 2).export(tmp_path / "made" / "big.ply")
    assert run(arguments) == 0
    first, second, _ = told(capsys)
    assert "162 vertices" in first
    assert "is there already" in second
    assert run([*arguments, "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")


def test_new_weights_are_run_anew(suite: Path, tmp_path: Path, capsys: Capture) -> None:
    weights = tmp_path / "w.safetensors"
    other = 'method = "hdpea"\nembedding = "learned"\nweights = "w.safetensors"\n'
    suite.write_text(suite.read_text().split('method = "folder"')[0] + other)
    arguments = ["benchmark", str(suite), str(tmp_path / "out"), "--models", "1"]
    for seed in (0, 1):
        write_weights(weights, network_of(replace(TINY, seed=seed)))
        assert run(arguments) == 0
        assert "is there already" not in told(capsys)[0]
    assert run(arguments) == 0
    assert "is there already" in told(capsys)[0]


def test_what_fails_is_told_and_tried_again(suite: Path, tmp_path: Path, capsys: Capture, failed: Failed) -> None:
    out = tmp_path / "out"
    (tmp_path / "made" / "big.ply").rename(tmp_path / "made" / "away.ply")
    assert run(["benchmark", str(suite), str(out)]) == 0
    first, _, last = told(capsys)
    assert "failed: There is no file" in first
    assert "1 failed" in last
    assert "There is no file" in (out / "results.md").read_text()
    (tmp_path / "made" / "away.ply").rename(tmp_path / "made" / "big.ply")
    assert run(["benchmark", str(suite), str(out)]) == 0
    assert "42 vertices" in told(capsys)[0]
    suite.write_text(suite.read_text().replace('title = "', 'time_limit = 0\ntitle = "'))
    assert "Not one run" in failed(5, "benchmark", suite, tmp_path / "none")
    assert "longer than 0 s" in (tmp_path / "none" / "results.md").read_text()


def test_what_cannot_be_run_is_told(suite: Path, tmp_path: Path, failed: Failed) -> None:
    assert "no suite" in failed(3, "benchmark", "nothing", tmp_path / "out")
    assert "no file or folder" in failed(3, "benchmark", suite, tmp_path / "out", "--meshes", tmp_path / "absent")
    assert "no method 'x'" in failed(2, "benchmark", suite, tmp_path / "out", "--method", "x")
    assert "Cannot write" in failed(2, "benchmark", suite, suite)
    suite.write_text(suite.read_text().replace('meshes = "meshes"', ""))
    assert "does not say where" in failed(2, "benchmark", suite, tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_pictures_are_drawn_once_and_are_in_the_page(suite: Path, tmp_path: Path) -> None:
    suite.write_text(suite.read_text().replace("pictures = 0", "pictures = 1"))
    out = tmp_path / "out"
    assert run(["benchmark", str(suite), str(out), "--quiet"]) == 0
    pictures = sorted(path.relative_to(out / "pictures").as_posix() for path in out.rglob("*.webp"))
    assert pictures == ["clean/small/coarse@42.error.webp", "clean/small/coarse@42.webp", "small.webp"]
    assert (out / "index.html").read_text().count("data:image/webp;base64,") == 3
    times = {path: path.stat().st_mtime_ns for path in out.rglob("*.webp")}
    assert run(["benchmark", str(suite), str(out), "--quiet"]) == 0
    assert {path: path.stat().st_mtime_ns for path in out.rglob("*.webp")} == times
    assert "Turn them" not in (out / "index.html").read_text()
    assert run(["benchmark", str(suite), str(out), "--quiet", "--page"]) == 0
    assert 'href="pictures/small-clean-42.html"' in (out / "index.html").read_text()
    shown = (out / "pictures" / "small-clean-42.html").read_text()
    assert '"name":"coarse"' in shown
    assert '"name":"the truth"' in shown


def test_models_are_chosen_evenly() -> None:
    assert evenly("abcdef", 0) == list("abcdef")
    assert evenly("abcdef", 9) == list("abcdef")
    assert evenly("abcdef", 2) == ["b", "e"]
    assert evenly("abcdef", 1) == ["d"]


def cloud_of(**degradation: float) -> Cloud:
    estimate = bool(degradation.pop("estimate", 0))
    given = SuiteInput("test", SampleOptions(estimate=estimate), ScanOptions(2000), DegradationOptions(**degradation))
    return make_cloud(ball(radius=5), "ball", given, seed=0)


def test_clouds_are_the_same_again_and_in_world_units() -> None:
    clean, again, noisy = cloud_of(), cloud_of(), cloud_of(noise=0.01)
    np.testing.assert_array_equal(clean.points, again.points)
    np.testing.assert_allclose(np.linalg.norm(clean.points, axis=1), 5, rtol=0.02)
    np.testing.assert_allclose(np.linalg.norm(clean.normals, axis=1), 1, rtol=1e-6)
    assert np.std(noisy.points - clean.points) == pytest.approx(0.01 * 10 * 3**0.5, rel=0.1)


def test_scans_see_the_outside() -> None:
    pytest.importorskip("embreex")
    given = SuiteInput("test", SampleOptions(kind="scan"), ScanOptions(2000, views=1), DegradationOptions())
    scan = make_cloud(ball(radius=5), "ball", given, seed=0)
    assert scan.points.shape == (2000, 3)
    assert np.linalg.norm(scan.points.mean(axis=0)) > 1  # one side is missing


def test_normals_are_the_true_ones_unless_they_are_to_be_estimated() -> None:
    true, estimated = cloud_of(), cloud_of(estimate=1)
    outward = true.points / np.linalg.norm(true.points, axis=1, keepdims=True)
    assert np.einsum("nc,nc->n", true.normals, outward).min() > 0.97
    assert not np.array_equal(true.normals, estimated.normals)
    assert np.median(np.einsum("nc,nc->n", estimated.normals, outward)) > 0.99


@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "values", "library"),
    [
        ("hdpea", {}, "torch"),
        ("poisson", {"depth": 5, "reduce": "fast"}, "fast_simplification"),
        ("poisson", {"depth": 5, "reduce": "quadric"}, "pymeshlab"),
        ("poisson", {"depth": 5, "reduce": "acvd"}, "pyacvd"),
        ("poisson", {"depth": 5, "reduce": "mmg"}, "mmgpy"),
        ("ball_pivoting", {"reduce": "quadric"}, "pymeshlab"),
        ("co3ne", {"reduce": "cvt"}, "geogram"),
        ("advancing_front", {"reduce": "fast"}, "CGAL"),
    ],
)
def test_methods_make_meshes_of_the_wanted_size(
    method: str, values: dict[str, object], library: str, tmp_path: Path
) -> None:
    pytest.importorskip(library)
    pytest.importorskip("pymeshlab" if method in ("poisson", "ball_pivoting") else library)
    method_options(method, values)
    made = run_method(Task(cloud_of(), method, values, 200, tmp_path))
    vertices, faces = made.mesh
    # mmgs takes a metric and not a number of vertices, and answers in steps.
    assert len(vertices) == pytest.approx(200, rel=0.05 if library == "mmgpy" else 0.02)
    assert faces.max() == len(vertices) - 1
    assert abs(np.linalg.norm(vertices, axis=1) - 5).max() < 1
    assert made.peak_bytes > 10_000_000


def test_a_missing_compiler_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("geogram")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("PATH", "")
    monkeypatch.delitem(sys.modules, "hdpea.benchmark.methods.geogram", raising=False)
    with pytest.raises(UsageError, match=r"needs a C\+\+ compiler"):
        import_module("hdpea.benchmark.methods.geogram")
