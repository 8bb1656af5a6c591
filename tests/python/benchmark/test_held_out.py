# SPDX-License-Identifier: GPL-3.0-or-later
"""Suites of clouds whose surface nobody knows: half of the points are held out, and are the truth."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from helpers import clouds
from numpy.typing import NDArray

from hdpea.benchmark.held_out import HeldOut, halves_of, make_cloud_of_points
from hdpea.benchmark.methods import Cloud, method_options
from hdpea.benchmark.scene import LIGHT, PointScene, shades
from hdpea.benchmark.suite import HELD_OUT, SuiteInput, SuiteOptions
from hdpea.benchmark.true_surface import TrueSurface
from hdpea.benchmark.worker import Task, run_method
from hdpea.cli import run
from hdpea.dataset.options import DegradationOptions, SampleOptions, ScanOptions
from hdpea.dataset.sources import Source
from hdpea.errors import CannotReconstruct, UsageError
from hdpea.reading.cloud import PointCloud
from hdpea.writing.points import point_ply

Array = NDArray[np.float64]


def written(path: Path, points: Array, normals: Array | None = None) -> Source:
    path.parent.mkdir(exist_ok=True)
    if normals is None:
        np.savetxt(path, points)
    else:
        path.write_bytes(point_ply(points, normals, {}))
    return Source(path.stem, path.name, path)


def asked(points: int = 10_000, estimate: bool = False, **degradation: float) -> SuiteInput:
    return SuiteInput("x", SampleOptions(estimate=estimate), ScanOptions(points), DegradationOptions(**degradation))


def model(source: Source, seed: int = 0) -> HeldOut:
    return HeldOut(source, SuiteOptions(truth=HELD_OUT, seed=seed, samples=2000))


def rows(points: Array) -> set[tuple[float, ...]]:
    return set(map(tuple, points.tolist()))


def in_world(model: HeldOut) -> Array:
    return model.truth.points * model.truth.longest_side + model.truth.centre_in_world


def between(points: Array, others: Array) -> Array:
    """Return the distance from each point to the nearest other."""
    return np.linalg.norm(points[:, None] - others[None], axis=2).min(axis=1)


@pytest.mark.parametrize("count", [1000, 1001])
def test_halves_share_no_point_and_are_the_cloud_together(count: int) -> None:
    points, normals = clouds.sphere(count)
    given, held_out = halves_of(PointCloud(points, normals), seed=0)
    assert len(held_out.points) - len(given.points) == count % 2
    assert not rows(given.points) & rows(held_out.points)
    assert rows(given.points) | rows(held_out.points) == rows(points)
    np.testing.assert_array_equal(given.normals, given.points)  # on a sphere: each row keeps its own
    # At random: a file in scan order would hold out one side.
    assert np.linalg.norm(held_out.points.mean(axis=0)) < 0.2


def test_a_file_in_order_is_not_cut_in_order() -> None:
    points, _ = clouds.plane(1000)
    in_order = points[np.argsort(points[:, 0])]
    for half in halves_of(PointCloud(in_order), seed=0):
        assert half.points[:, 0].mean() == pytest.approx(0.5, abs=0.05)
        assert half.points[:50, 0].mean() == pytest.approx(0.5, abs=0.15)  # so may be the first of them, that are given


def test_the_truth_does_not_depend_on_what_is_given(tmp_path: Path) -> None:
    source = written(tmp_path / "ball.ply", *clouds.sphere(1000))
    few, many, all_there_are = (model(source).cloud(asked(points)) for points in (100, 400, 10_000))
    np.testing.assert_allclose(many.points[:100], few.points)
    assert (len(few.points), len(many.points), len(all_there_are.points)) == (100, 400, 500)
    one, again, other = (model(source, seed) for seed in (0, 0, 1))
    again.cloud(asked(100, noise=0.1))
    np.testing.assert_array_equal(one.truth.points, again.truth.points)
    assert rows(in_world(one).round(6)) != rows(in_world(other).round(6))


def test_what_is_given_is_not_in_the_truth(tmp_path: Path) -> None:
    source = written(tmp_path / "ball.ply", *clouds.sphere(1000))
    ball = model(source)
    given, truth = ball.cloud(asked()).points, in_world(ball)
    assert between(given, truth).min() > 1e-5  # points are given in single precision, which is a hundredth of that
    together = np.vstack([given, truth])
    assert len(together) == 1000
    assert between(clouds.sphere(1000)[0], together).max() < 1e-6


def test_normals_of_the_file_are_given_as_they_are(tmp_path: Path) -> None:
    ball = model(written(tmp_path / "ball.ply", *clouds.sphere(1000)))
    given = ball.cloud(asked())
    np.testing.assert_allclose(given.normals, given.points, atol=1e-6)
    assert ball.truth.normals is not None
    estimated = ball.cloud(asked(estimate=True))
    assert not np.allclose(estimated.normals, estimated.points, atol=1e-3)
    assert np.median(np.einsum("nc,nc->n", estimated.normals, estimated.points)) > 0.99


def test_normals_are_estimated_and_oriented_where_there_are_none(tmp_path: Path) -> None:
    ball = model(written(tmp_path / "ball.xyz", clouds.sphere(2000)[0]))
    given = ball.cloud(asked())
    assert ball.truth.normals is None
    assert np.median(np.einsum("nc,nc->n", given.normals, given.points)) > 0.99
    points, normals = clouds.sphere(1000)
    known = np.where(np.arange(1000)[:, None] % 2, normals, 0)
    mixed = make_cloud_of_points(PointCloud(points, known), "ball", asked(), 0)
    np.testing.assert_allclose(mixed.normals[1::2], normals[1::2], atol=1e-6)
    assert np.einsum("nc,nc->n", mixed.normals[::2], normals[::2]).min() > 0.9


def test_points_and_normals_are_made_worse_as_they_are_of_a_surface() -> None:
    cloud = PointCloud(*clouds.sphere(2000))
    clean, noisy, wrong, tilted = (
        make_cloud_of_points(cloud, "ball", given, 0)
        for given in (asked(), asked(noise=0.01), asked(flipped=0.3), asked(normal_noise=0.1))
    )
    assert np.std(noisy.points - clean.points) == pytest.approx(0.01 * 2 * 3**0.5, rel=0.1)
    np.testing.assert_array_equal(wrong.points, clean.points)
    assert (np.einsum("nc,nc->n", wrong.normals, clean.normals) < 0).mean() == pytest.approx(0.3)
    assert np.std(tilted.normals - clean.normals) == pytest.approx(0.1 * (2 / 3) ** 0.5, rel=0.1)


def test_clouds_that_are_no_surface_are_refused(tmp_path: Path) -> None:
    line = model(written(tmp_path / "line.xyz", np.linspace([0, 0, 0], [1, 2, 3], 200)))
    with pytest.raises(CannotReconstruct, match="line"):
        line.cloud(asked())
    lonely = model(written(tmp_path / "one.xyz", np.ones((1, 3))))
    with pytest.raises(CannotReconstruct, match="a single point"):
        lonely.cloud(asked())
    with pytest.raises(UsageError, match="leaves no points"):
        make_cloud_of_points(PointCloud(*clouds.sphere(50)), "ball", asked(missing=1, missing_radius=2), 0)


def test_a_file_taken_for_points_is_not_the_file_taken_for_a_surface(tmp_path: Path) -> None:
    source = written(tmp_path / "ball.ply", *clouds.sphere(100))
    content = model(source).content
    assert content != TrueSurface(source, SuiteOptions()).content
    assert content == model(source).content
    written(tmp_path / "ball.ply", *clouds.sphere(101))
    assert content != model(source).content


SUITE = """
title = "scans"
truth = "held_out"
meshes = "clouds"
points = 300
samples = 2000
vertices = 42
pictures = {pictures}

[[input]]
name = "scan"

[[method]]
name = "exact"
method = "folder"
path = "exact/{{model}}.ply"

[[method]]
name = "away"
method = "folder"
path = "away/{{model}}.ply"
"""


@pytest.fixture
def suite(tmp_path: Path) -> Callable[[int], list[str]]:
    """Clouds of a square, without normals, and of a cube, with them; their surfaces, and the same 0.03 away."""
    written(tmp_path / "clouds" / "square.xyz", clouds.plane(2000)[0])
    written(tmp_path / "clouds" / "cube.ply", *clouds.box(3000))
    square = trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    for name, mesh in (("square", square), ("cube", trimesh.creation.box())):
        for folder, shift in (("exact", 0.0), ("away", 0.03)):
            (tmp_path / folder).mkdir(exist_ok=True)
            mesh.copy().apply_translation([0, 0, shift]).export(tmp_path / folder / f"{name}.ply")

    def arguments(pictures: int = 0) -> list[str]:
        (tmp_path / "suite.toml").write_text(SUITE.format(pictures=pictures))
        return ["benchmark", str(tmp_path / "suite.toml"), str(tmp_path / "out")]

    return arguments


def test_a_suite_of_clouds_is_run_and_continued(
    suite: Callable[..., list[str]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert run(suite()) == 0
    lines = capsys.readouterr().err.splitlines()
    assert "scan/cube/exact@42: 8 vertices, rms 0.000 % of the longest side" in lines[0]
    assert "scan/square/away@42: 4 vertices, rms 3.0" in lines[3]
    with (out / "results.csv").open() as file:
        of = {(row["model"], row["method"]): row for row in csv.DictReader(file)}
    for name, count in (("cube", 1500), ("square", 1000)):
        exact, away = of[name, "exact"], of[name, "away"]
        assert (exact["truth"], exact["truth_points"]) == ("points", str(count))
        assert float(exact["accuracy.longest_side.to_result.rms"]) < 1e-6
        assert float(away["accuracy.longest_side.to_result.max"]) == pytest.approx(0.03, rel=0.01)
    told = (out / "results.md").read_text()
    assert "| exact | 2/2 | 6 | **0.000** | **0.000** |" in told
    assert "which no method was given" in told
    assert "Smallest exact rms: exact on cube, square. Smallest CD: exact on cube, square." in told
    page = (out / "index.html").read_text()
    assert "which no method was given" in page
    assert len(list((out / "clouds").rglob("*.ply"))) == 2

    assert run(suite()) == 0
    assert all("is there already" in line for line in capsys.readouterr().err.splitlines()[:-1])
    written(tmp_path / "clouds" / "square.xyz", clouds.plane(2000, seed=1)[0])
    assert run(suite()) == 0
    assert ["already" in line for line in capsys.readouterr().err.splitlines()[:-1]] == [True, True, False, False]


@pytest.mark.slow
def test_clouds_are_drawn_with_what_is_made_of_them(suite: Callable[..., list[str]], tmp_path: Path) -> None:
    assert run([*suite(1), "--quiet"]) == 0
    pictures = sorted(path.relative_to(tmp_path / "out/pictures").as_posix() for path in tmp_path.rglob("*.webp"))
    assert pictures[-1] == "square.webp"
    assert len(pictures) == 5
    page = (tmp_path / "out/index.html").read_text()
    assert page.count("data:image/webp;base64,") == 5
    assert "from each point of the truth to the surface of the result" in page
    assert "rms 3.0" in page
    assert "G 0" not in page


def test_points_are_shaded_on_either_side() -> None:
    across = np.array([1, -LIGHT[0] / LIGHT[1], 0])
    lit, behind, aside = shades(np.vstack([LIGHT, -LIGHT, across / np.linalg.norm(across)]))
    np.testing.assert_array_equal(lit, behind)
    assert (lit > aside + 100).all()
    assert np.linalg.norm(LIGHT) == pytest.approx(1, abs=0.01)


def test_a_cloud_is_seen_from_the_side_it_faces() -> None:
    points, normals = clouds.plane(500)
    scene = PointScene.of(points, normals)
    assert (scene.normals @ scene.camera.view_from_world.T)[:, 2].min() > 0.5
    assert len(scene.shown) == 500


@pytest.mark.slow
def test_a_trimmed_poisson_surface_stays_near_the_points(tmp_path: Path) -> None:
    pytest.importorskip("pymeshlab")
    points, normals = (each[each[:, 2] < 0.3] for each in clouds.sphere(4000))  # an open bowl
    made = {}
    for trim in (0.0, 1.0):
        values = {"depth": 6, "reduce": "none", "trim": trim}
        method_options("poisson", values)
        made[trim] = run_method(Task(Cloud(points, normals, "bowl", "x"), "poisson", values, 100, tmp_path)).mesh
    assert between(made[0.0][0], points).max() > 0.3  # the lid
    assert between(made[1.0][0], points).max() < 0.15
    assert between(points, made[1.0][0]).max() < 0.15  # nothing else is lost
    assert made[1.0][1].max() == len(made[1.0][0]) - 1
