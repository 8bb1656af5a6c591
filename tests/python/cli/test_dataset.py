# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset``: its commands, their outputs and their errors."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from helpers import dataset_standins
from helpers.dataset_standins import open_mesh, write_meshes
from helpers.samples import sphere_sample

from hdpea.cli import run
from hdpea.dataset.manifest import read_manifest
from hdpea.dataset.sample_file import read_sample, write_sample
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.reading import read_points

Capture = pytest.CaptureFixture[str]
Failed = Callable[..., str]


@pytest.fixture
def _stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.dataset.build.make_samples", dataset_standins.make_samples)


def build(meshes: Path, output: Path, *flags: str) -> list[str]:
    return ["dataset", "build", str(meshes), str(output), "--jobs", "1", *flags]


@pytest.mark.usefixtures("_stand_in")
def test_a_build_says_what_became_of_each_mesh(tmp_path: Path, capsys: Capture) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "bug", "c")
    assert run(build(meshes, tmp_path / "out", "--points", "100")) == 0
    out, told = capsys.readouterr()
    assert out == ""
    assert "a: 100 points, 0.0 MB" in told
    assert "bug: skipped: ZeroDivisionError: a bug (2 of 3)" in told
    assert "meshes: 2 built, 0 there already, 1 skipped" in told
    assert "out: 2 samples, 0.0 MB" in told
    assert run(build(meshes, tmp_path / "out", "--points", "100", "--quiet")) == 0
    assert capsys.readouterr() == ("", "")


@pytest.mark.usefixtures("_stand_in")
def test_a_dataset_is_built_again_from_its_manifest(tmp_path: Path, capsys: Capture, failed: Failed) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "b")
    assert run(build(meshes, tmp_path / "out", "--points", "70", "--seed", "5", "--kind", "farthest")) == 0
    like = str(tmp_path / "out" / "manifest.json")
    again = build(meshes, tmp_path / "again", "--like", like)
    assert "--like and --seed exclude each other" in failed(2, *again, "--seed", "5")
    assert run(again) == 0
    for file in ("manifest.json", "DATASET_CARD.md", "samples/a.npz"):
        assert (tmp_path / "again" / file).read_bytes() == (tmp_path / "out" / file).read_bytes()
    write_meshes(tmp_path / "others", "0", "a", "b")
    assert "The mesh a is not the one" in failed(5, *build(tmp_path / "others", tmp_path / "third", "--like", like))
    capsys.readouterr()


@pytest.mark.usefixtures("_stand_in")
def test_the_facts_of_a_dataset_are_told(tmp_path: Path, capsys: Capture) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "bug", "c")
    assert run(build(meshes, tmp_path / "out", "--points", "100", "--quiet")) == 0
    assert run(["dataset", "info", str(tmp_path / "out")]) == 0
    told = capsys.readouterr().out
    for fact in ("2 of 2 meshes, all whole", "points        200", "skipped bug:", "licence 0 | 1 | 1 |", "seed 0"):
        assert fact in told


def test_the_facts_of_a_sample_are_told(tmp_path: Path, capsys: Capture) -> None:
    write_sample(tmp_path / "sample.npz", sphere_sample(noise=0.01, scanned=True))
    assert run(["dataset", "info", str(tmp_path / "sample.npz")]) == 0
    told = capsys.readouterr().out
    assert "points        50" in told
    assert "estimated_normals, sensors" in told
    assert "diagonal 7 around 1 2 3" in told
    for known in ("stretch along k1", "isometry error", "roughness"):
        assert known in told


def test_a_scan_as_ply_can_be_reconstructed_and_knows_its_sensors(tmp_path: Path) -> None:
    ball = trimesh.creation.icosphere(subdivisions=3, radius=5)
    ball.apply_translation([100, 0, 0])
    ball.export(tmp_path / "ball.ply")
    arguments = ["dataset", "scan", str(tmp_path / "ball.ply"), str(tmp_path / "scan.ply"), "--quiet"]
    assert run([*arguments, "--points", "3000", "--noise", "0"]) == 0
    scan = read_points(tmp_path / "scan.ply")
    assert scan.points.shape == (3000, 3)
    np.testing.assert_allclose(np.linalg.norm(scan.points - [100, 0, 0], axis=1), 5, rtol=0.01)
    sensors = np.stack([scan.attributes[f"sensor_{axis}"] for axis in "xyz"], axis=1)
    distance = 1.5 * UnitFrame.around(np.asarray(ball.vertices)).diagonal
    np.testing.assert_allclose(np.linalg.norm(sensors - [100, 0, 0], axis=1), distance)
    assert scan.normals is not None
    assert (np.einsum("nc,nc->n", scan.normals, sensors - scan.points) > 0).all()


def test_a_scan_with_faults_keeps_the_sensor_of_each_point(tmp_path: Path) -> None:
    trimesh.creation.icosphere(subdivisions=3).export(tmp_path / "ball.ply")
    arguments = ["dataset", "scan", str(tmp_path / "ball.ply"), "--quiet", "--points", "1000", "--sensor", "lidar"]
    read = {}
    for name, faults in {
        "clean": [],
        "faulty": ["--outliers", "5%", "--step", "0.1%", "--noise-growth", "linear"],
    }.items():
        assert run([*arguments, str(tmp_path / f"{name}.ply"), *faults]) == 0
        read[name] = read_points(tmp_path / f"{name}.ply")
    assert (abs(np.linalg.norm(read["faulty"].points, axis=1) - 1) > 0.1).sum() == pytest.approx(50, abs=15)
    for axis in "xyz":
        sensors = (read[name].attributes[f"sensor_{axis}"] for name in ("clean", "faulty"))
        np.testing.assert_array_equal(*sensors)


def test_what_cannot_be_scanned_is_told(tmp_path: Path, failed: Failed) -> None:
    open_mesh(tmp_path / "open.ply")
    assert "3 edges at holes" in failed(4, "dataset", "scan", tmp_path / "open.ply", tmp_path / "scan.ply")
    assert "no file" in failed(3, "dataset", "scan", tmp_path / "absent.ply", tmp_path / "scan.ply")
    assert "extension" in failed(2, "dataset", "scan", tmp_path / "open.ply", tmp_path / "scan.obj")
    assert "both input and output" in failed(2, "dataset", "scan", tmp_path / "open.ply", tmp_path / "open.ply")
    assert not (tmp_path / "scan.ply").exists()


def test_a_missing_library_is_told_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failed: Failed) -> None:
    meshes = write_meshes(tmp_path / "meshes", "a", "b")
    monkeypatch.setattr("hdpea.dataset.raycasting.find_spec", lambda _: None)
    assert "embreex is not installed" in failed(2, *build(meshes, tmp_path / "out", "--kind", "scan"))
    assert not (tmp_path / "out").exists()


def test_what_makes_a_sample_worse_is_listed_as_that(capsys: Capture) -> None:
    assert run(["dataset", "degrade", "--help"]) == 0
    told = capsys.readouterr().out
    assert told.index("Degradation:") < told.index("--outliers")
    assert "Run:" not in told


def test_a_sample_is_made_worse(tmp_path: Path, failed: Failed) -> None:
    write_sample(tmp_path / "sample.npz", sphere_sample(count=2000, scanned=True))
    degrade = ["dataset", "degrade", str(tmp_path / "sample.npz")]
    assert run([*degrade, str(tmp_path / "noisy.npz"), "--noise", "0.3%", "--missing", "1"]) == 0
    noisy = read_sample(tmp_path / "noisy.npz")
    assert 1000 < len(noisy.points) < 2000
    assert np.std(noisy.points - noisy.surface_points) == pytest.approx(0.003, rel=0.1)
    assert noisy.estimated_normals is not None
    assert np.median(np.einsum("nc,nc->n", noisy.estimated_normals, noisy.normals)) > 0.9
    assert "both input and output" in failed(2, *degrade, tmp_path / "sample.npz")
    assert "extension" in failed(2, *degrade, tmp_path / "noisy.ply")
    assert "outliers is at most 1" in failed(2, *degrade, tmp_path / "noisy.npz", "--outliers", "2")


def test_no_samples_and_no_datasets_are_told(tmp_path: Path, failed: Failed) -> None:
    (tmp_path / "sample.npz").write_bytes(b"PK")
    assert "not a dataset" in failed(3, "dataset", "info", tmp_path)
    assert "Cannot read" in failed(3, "dataset", "info", tmp_path / "sample.npz")
    assert "Cannot read" in failed(3, "dataset", "show", tmp_path / "sample.npz", tmp_path / "sample.png")
    assert "extension" in failed(2, "dataset", "show", tmp_path / "sample.npz", tmp_path / "sample.gif")
    assert "no file or folder" in failed(3, *build(tmp_path / "absent", tmp_path / "out"))
    assert "kind" in failed(2, *build(tmp_path, tmp_path / "out", "--kind", "cubes"))
    assert "not a number such as" in failed(2, *build(tmp_path, tmp_path / "out", "--noise", "loud"))


@pytest.mark.slow
def test_a_sample_is_drawn(tmp_path: Path) -> None:
    write_sample(tmp_path / "sample.npz", sphere_sample(count=2000))
    assert run(["dataset", "show", str(tmp_path / "sample.npz"), str(tmp_path / "sample.png")]) == 0
    from PIL import Image

    with Image.open(tmp_path / "sample.png") as image:
        pixels = np.asarray(image.convert("L"), dtype=float)
    assert pixels.shape == (800, 2400)
    for panel in np.split(pixels, 3, axis=1):
        # A disk fills 0.79 of its square; the corners are the background.
        assert 0.6 < (panel < 254).mean() < 0.85
        assert (panel[[0, 0, -1, -1], [0, -1, 0, -1]] == 255).all()


def test_a_manifest_records_what_was_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.dataset.build.make_samples", dataset_standins.make_samples)
    meshes = write_meshes(tmp_path / "meshes", "a")
    flags = ["--points", "60", "--kind", "scan", "--views", "3", "--remesh-length", "2%", "--estimate", "--augmented"]
    assert run(build(meshes, tmp_path / "out", *flags, "--quiet")) == 0
    options = read_manifest(tmp_path / "out").options
    assert options["sample"] == {"kind": "scan", "estimate": True, "augmented": True}
    assert (options["scanning"]["points"], options["scanning"]["views"]) == (60, 3)
    assert options["ground_truth"]["remesh_length"] == 0.02
