# SPDX-License-Identifier: GPL-3.0-or-later
"""Suites: what they may say, and what is refused before anything runs."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from hdpea.benchmark import methods
from hdpea.benchmark.suite_file import read_suite, shipped_suites
from hdpea.cli.benchmark import command
from hdpea.dataset.discovery import find_meshes
from hdpea.dataset.surface_file import read_surface
from hdpea.errors import UnreadableInput, UsageError
from hdpea.options.lengths import Length

ROOT = Path(__file__).parents[3]
DOCS = (ROOT / "docs" / "benchmark.md").read_text()

SUITE = """
title = "all of it"
meshes = "meshes"
vertices = [500, 1_000]
points = 2_000

[[input]]
name = "clean"

[[input]]
name = "scan"
kind = "scan"
estimate = true
noise = 0.003
points = 3_000
scan = { views = 3, sensor = "turntable" }

[[method]]
method = "hdpea"
refine = false
curvature_radius = "1%"

[[method]]
name = "made elsewhere"
method = "folder"
path = "else/{model}.ply"

[[method]]
name = "a program"
method = "command"
run = "program {points} {mesh} {vertices}"

[[quoted]]
name = "a method"
source = "table 1"
chamfer = 0.5
"""


@pytest.fixture(autouse=True)
def _libraries_are_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(methods, "find_spec", lambda _: object())


def written(folder: Path, text: str) -> str:
    path = folder / "suite.toml"
    path.write_text(text)
    return str(path)


def test_a_suite_says_what_to_run(tmp_path: Path) -> None:
    suite = read_suite(written(tmp_path, SUITE))
    assert (suite.name, suite.options.title) == ("suite", "all of it")
    assert suite.options.vertices == (500, 1000)
    assert suite.meshes == str(tmp_path / "meshes")
    clean, scan = suite.inputs
    assert (clean.sample.kind, clean.degradation.noise) == ("area", 0)
    assert (scan.sample.kind, scan.sample.estimate, scan.degradation.noise) == ("scan", True, 0.003)
    assert (scan.scan.views, scan.scan.sensor, scan.scan.points) == (3, "turntable", 3000)
    assert clean.scan.points == 2000
    ours, other, program = suite.methods
    assert (ours.name, other.name, other.method) == ("hdpea", "made elsewhere", "folder")
    assert ours.options().refinement.refine is False
    assert ours.options().embedding.curvature_radius == Length(1, percent=True)
    assert other.options().path == str(tmp_path / "else" / "{model}.ply")
    assert program.options().folder == str(tmp_path)
    assert program.options().words("p.ply", "m.ply", 500) == ["program", "p.ply", "m.ply", "500"]
    assert suite.quoted[0].chamfer == 0.5


def test_fewer_models_can_be_taken(tmp_path: Path) -> None:
    assert read_suite(written(tmp_path, SUITE)).options.models == 0
    assert read_suite(written(tmp_path, SUITE), models=3).options.models == 3
    with pytest.raises(UsageError, match="`models` is at least 0"):
        read_suite(written(tmp_path, SUITE), models=-1)


def test_the_failure_case_comes_with_its_mesh() -> None:
    (source,) = find_meshes(read_suite("failure").meshes)
    vertices, faces = read_surface(source.path)
    assert source.name == "slender_pipe"
    assert len(vertices) - len(faces) / 2 == 0  # Euler: a closed surface with one handle


def test_methods_can_be_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(methods, "find_spec", lambda name: None if name == "torch" else object())
    path = written(tmp_path, SUITE)
    (only,) = read_suite(path, ["made elsewhere"]).methods
    assert only.name == "made elsewhere"
    with pytest.raises(UsageError, match="needs torch"):
        read_suite(path)
    with pytest.raises(UsageError, match="no method 'yours'") as caught:
        read_suite(path, ["yours"])
    assert "'hdpea', 'made elsewhere', 'a program'" in caught.value.hint


@pytest.mark.parametrize("name", shipped_suites())
def test_the_suites_that_come_with_hdpea_are_in_order(name: str) -> None:
    suite = read_suite(name)
    assert suite.options.title
    assert "hdpea" in [method.method for method in suite.methods]
    assert f"| `{name}` |" in DOCS
    assert re.search(rf"\b{name}\b", str(command.help))


@pytest.mark.parametrize("path", sorted((ROOT / "benchmarks").glob("*.toml")), ids=lambda path: path.stem)
def test_the_suites_of_the_repository_are_in_order(path: Path) -> None:
    suite = read_suite(str(path))
    assert suite.options.title
    assert f"| `{path.name}` |" in DOCS
    for method in suite.methods:
        if method.method == "command":
            assert (path.parent / method.options().words("points", "mesh", 5)[1]).is_file()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("points = 2_000", "point = 2_000", "unknown key 'point'"),
        ("points = 2_000", "points = 'many'", "points = 'many'"),
        ("points = 2_000", "points = true", "points = True"),
        ("points = 2_000", "points = 3", "`points` is at least 100"),
        ("[500, 1_000]", "[500, 2]", "vertices is"),
        ("[500, 1_000]", "[]", "vertices is"),
        ("noise = 0.003", "noises = 0.003", "'scan' has an unknown key 'noises'"),
        ("noise = 0.003", "noise = -1", "`noise` is at least 0"),
        ("points = 3_000", "points = 0.5", "'scan' has points = 0.5"),
        ("views = 3", "points = 3", "scan has an unknown key 'points'"),
        ('name = "scan"', 'name = "clean"', "Two inputs"),
        ('name = "made elsewhere"', 'name = "hdpea"', "Two methods"),
        ('name = "clean"', "", "has no name"),
        ('method = "folder"', 'method = "magic"', "no method 'magic'"),
        ("refine = false", "refines = false", "no option 'refines'"),
        ('"1%"', '"one"', "'one' is not a length"),
        ("{model}", "model", "has no {model}"),
        ("{points}", "points", "has no {points}"),
        ("{mesh}", "mesh", "or no {mesh}"),
        ("{vertices}", "{faces}", "cannot be filled in: 'faces'"),
        ("{vertices}", "'", "cannot be filled in: No closing quotation"),
        ('source = "table 1"', 'from = "table 1"', "unknown key 'from'"),
        ('title = "all of it"', "title = all", "is not TOML"),
        ("points = 2_000", "truth = 'guessed'", "`truth` is one of mesh, held_out"),
        ("points = 2_000", "truth = 'held_out'", "'scan' is of kind 'scan'"),
        ("points = 2_000", "truth = 'held_out'\nrendered = true", "cannot be rendered"),
    ],
)
def test_what_is_wrong_is_said(old: str, new: str, told: str, tmp_path: Path) -> None:
    assert old in SUITE
    with pytest.raises(UsageError) as caught:
        read_suite(written(tmp_path, SUITE.replace(old, new)))
    assert told in caught.value.message


def test_a_suite_without_inputs_or_methods_is_refused(tmp_path: Path) -> None:
    for table in ("[[input]]", "[[method]]"):
        with pytest.raises(UsageError, match=r"has no \[\[input\]\] or no \[\[method\]\]"):
            read_suite(written(tmp_path, SUITE.replace(table, "[[quoted]]")))


def test_suites_that_are_not_there_are_told(tmp_path: Path) -> None:
    with pytest.raises(UnreadableInput, match="no suite 'quik'") as caught:
        read_suite("quik")
    assert "quick" in caught.value.hint
    with pytest.raises(UnreadableInput, match="no file"):
        read_suite(str(tmp_path / "absent.toml"))


@pytest.mark.parametrize(
    ("method", "values", "library"),
    [
        ("poisson", {"reduce": "acvd"}, "pymeshlab"),
        ("poisson", {"reduce": "acvd"}, "pyacvd"),
        ("ball_pivoting", {"reduce": "fast"}, "fast_simplification"),
    ],
)
def test_missing_libraries_are_named(
    method: str, values: dict[str, Any], library: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(methods, "find_spec", lambda name: None if name == library else object())
    with pytest.raises(UsageError, match=f"needs {library}") as caught:
        methods.method_options(method, values)
    assert "hdpea[benchmark]" in caught.value.hint
