# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole pipeline: what must not matter, what it tells, and what it refuses."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from helpers import clouds
from helpers.reconstructions import assert_same_bytes, cloud_of, mesh_of, options

from hdpea import reconstruct
from hdpea.errors import CannotReconstruct, Interrupted, UnreadableInput, UsageError
from hdpea.mesh.particles import Particles, spread_particles
from hdpea.options import DenoisingOptions, Length, MeshingOptions, Options
from hdpea.reading.cleaning import cleaned
from hdpea.reading.cloud import from_arrays
from hdpea.reconstruction import PHASES
from hdpea.runtime.progress import ProgressCallback


@pytest.mark.parametrize("shape", ["sphere", "torus", "cube", "plate"])
def test_a_random_half_of_the_normals_flipped_gives_the_same_mesh(shape: str) -> None:
    points, normals = cloud_of(shape)
    signs = np.random.default_rng(5).choice([-1.0, 1.0], (len(normals), 1))
    flipped = reconstruct(points, signs * normals, options())
    assert_same_bytes(flipped, mesh_of(shape))
    (note,) = flipped.report.notes
    assert "point both ways" in note


@pytest.mark.parametrize("useless", [0.0, np.nan, np.inf])
def test_useless_normals_are_no_normals(useless: float) -> None:
    points, normals = cloud_of("cube")
    without = reconstruct(points, None, options())
    assert_same_bytes(reconstruct(points, np.full_like(normals, useless), options()), without)
    assert without.report.counts["normals_estimated"] == len(points)


def test_some_useless_normals_are_estimated_and_told() -> None:
    points, normals = cloud_of("torus")
    normals = normals.copy()
    normals[::10], normals[5::10] = 0, np.nan
    made = reconstruct(points, normals, options())
    assert (made.report.mesh.closed, made.report.mesh.genus) == (True, 1)
    assert made.report.counts["normals_estimated"] == 600
    assert made.report.notes == ["Normals that are zero or not finite, to be estimated: 600."]


def test_the_length_of_normals_does_not_matter() -> None:
    points, normals = cloud_of("torus")
    lengths = 2.0 ** np.random.default_rng(5).integers(-8, 9, (len(normals), 1))
    assert_same_bytes(reconstruct(points, lengths * normals, options()), mesh_of("torus"))


def test_what_is_dropped_does_not_matter_and_is_counted() -> None:
    points, normals = cloud_of("torus")
    dirty = np.vstack([points, points[::7], np.full((3, 3), np.nan), [[np.inf, 0, 0]]])
    made = reconstruct(dirty, np.vstack([normals, normals[::7], normals[:4]]), options())
    assert_same_bytes(made, mesh_of("torus"))
    counts = made.report.counts
    assert (counts["points"], counts["dropped_duplicates"], counts["dropped_non_finite"]) == (3000, 429, 4)
    assert len(made.report.notes) == 2


@pytest.mark.parametrize("apart", [1e-13, 1e-9, 1e-4])
def test_nearly_equal_points_do_no_harm(apart: float) -> None:
    points, _ = clouds.sphere(2000)
    shaken = points[:900] + apart * np.random.default_rng(6).normal(size=(900, 3))
    found = reconstruct(np.vstack([points, shaken]), None, options(250)).report.mesh
    assert found is not None
    assert (found.closed, found.genus, found.self_intersections) == (True, 0, 0)


def test_a_regular_grid_has_no_preferred_triangles_but_one_mesh() -> None:
    # Every four neighbours lie on one circle, so every Voronoi vertex is a tie.
    x, y = np.meshgrid(np.arange(40.0), np.arange(40.0))
    made = reconstruct(np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1), None, options(1600))
    assert (made.report.mesh.components, made.report.mesh.boundary_loops) == (1, 1)
    assert len(made.faces) == pytest.approx(2 * 39 * 39, rel=0.02)


def test_phases_come_in_order_and_any_of_them_can_stop_the_run() -> None:
    points, normals = clouds.sphere(500)
    told: list[tuple[str, float]] = []

    def listen(phase: str, fraction: float) -> bool:
        told.append((phase, fraction))
        return True

    every = replace(options(50), denoising=DenoisingOptions(denoise="mls"))
    every = replace(every, meshing=replace(every.meshing, lod=2), texture=64)
    colors = {"colors": np.full((500, 3), 200, np.uint8)}
    reconstruct(points, normals, every, listen, attributes=colors)
    assert tuple(dict.fromkeys(phase for phase, _ in told)) == PHASES
    assert all(0 <= fraction <= 1 for _, fraction in told)

    def stopping(at: str) -> ProgressCallback:
        return lambda phase, _: phase != at

    for stopped in PHASES:
        with pytest.raises(Interrupted):
            reconstruct(points, normals, every, stopping(stopped), attributes=colors)


def test_the_report_tells_everything(tmp_path: Path) -> None:
    made = reconstruct(clouds.torus(2000)[0])
    made.report.write(tmp_path / "report.json")
    told = json.loads((tmp_path / "report.json").read_text())
    assert told["version"]
    assert told["options"]["particles"]["seed"] == 0
    assert told["counts"]["points"] == 2000
    chosen = {choice["name"]: choice for choice in told["choices"]}
    wanted = {
        "vertices",
        "particles",
        "normal_neighbors",
        "orient",
        "denoise",
        "device",
        "bending_length",
        "curvature_radius",
        "iterations",
        "disk_radius",
        "fill_holes",
    }
    assert chosen.keys() == wanted
    assert (chosen.pop("orient")["value"], chosen.pop("denoise")["value"]) == ("wnnc", "none")
    assert chosen.pop("device")["value"].startswith(("cpu", "cuda"))
    for choice in chosen.values():
        assert choice["value"] > 0
        assert len(choice["why"]) > 10
    assert chosen["vertices"]["value"] == told["mesh"]["vertices"] == 250
    counted = {"t3", "t12", "t3_kept", "t12_kept", "holes_filled", "holes_left", "dropped_components"}
    assert counted | {"refused_edge", "refused_link", "refused_orientation", "refused_fold"} <= told["meshing"].keys()
    assert told["mesh"]["faces"] == len(made.faces)
    assert {"manifold", "closed", "components", "boundary_loops", "genus"} <= told["mesh"].keys()
    for unit in ("in_world_units", "in_spacings"):
        distances = told["distances"][unit]
        assert 0 < distances["mean"] < distances["rms"] < distances["percentile_95"] < distances["max"]
    asked_for = {"simplification", "remeshing", "attributes", "texture", "levels"}
    always = [phase for phase in PHASES if phase not in asked_for]
    assert [stage["name"] for stage in told["stages"]] == always
    assert all(stage["seconds"] > 0 and stage["peak_bytes"] > 1e6 for stage in told["stages"])


def test_what_is_given_is_not_chosen() -> None:
    told = mesh_of("torus", fill_holes=None).report.choices
    assert "vertices" not in {choice.name for choice in told}
    assert "normal_neighbors" not in {choice.name for choice in told}


@pytest.mark.parametrize(
    ("counts", "made", "missed"),
    [
        ((150, 194, 170), 194, ["200 vertices were asked for, and the mesh has 194."]),
        ((194, 260), 200, []),
        ((203,), 200, []),
    ],
)
def test_too_few_vertices_call_for_more_particles_and_too_many_are_collapsed(
    counts: tuple[int, ...], made: int, missed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    others = iter(counts)

    def spread_other_count(coordinates: Any, bases: Any, neighbors: Any, _: int, **options: Any) -> Particles:
        return spread_particles(coordinates, bases, neighbors, next(others), **options)

    monkeypatch.setattr("hdpea.mesh.assembly.spread_particles", spread_other_count)
    mesh = reconstruct(*clouds.sphere(1600), Options(meshing=MeshingOptions(vertices=200)))
    assert len(mesh.vertices) == made
    assert mesh.report.missed == missed
    assert list(others) == []


@pytest.mark.parametrize("budget", [MeshingOptions(vertices=301), MeshingOptions(faces=700)])
def test_more_vertices_than_points_are_refused(budget: MeshingOptions) -> None:
    with pytest.raises(UsageError, match="300 distinct points"):
        reconstruct(*clouds.sphere(300), Options(meshing=budget))


def six_small_balls() -> clouds.Array:
    """Return balls of 13 points, each of which gets too few faces to stay."""
    return np.vstack([clouds.sphere_points(13, i) * (0.3 + 0.15 * i) + [1.1 * i, 0, 0] for i in range(6)])


@pytest.mark.parametrize(
    ("points", "error", "reason"),
    [
        (np.empty((0, 3)), UnreadableInput, "no points"),
        (np.full((50, 3), np.nan), UnreadableInput, "finite"),
        (np.ones((50, 3)), CannotReconstruct, "equal"),
        (np.arange(50.0)[:, None] * [1.0, 2.0, 3.0], CannotReconstruct, "on a line"),
        (clouds.sphere(15)[0], CannotReconstruct, "too few"),
        (six_small_balls(), CannotReconstruct, "No face is left"),
        (np.zeros((50, 2)), UsageError, "shape"),
    ],
)
def test_what_holds_no_surface_is_refused(points: clouds.Array, error: type[Exception], reason: str) -> None:
    with pytest.raises(error, match=reason):
        reconstruct(points)


def test_common_options_are_keywords_and_overrule_the_options() -> None:
    points, normals = cloud_of("sphere")
    made = reconstruct(points, normals, options(vertices=500, refine=False), vertices=200, seed=3, fill_holes="2%")
    asked = made.report.options
    assert (asked.meshing.vertices, asked.particles.seed, asked.meshing.fill_holes) == (200, 3, Length(2, percent=True))
    assert not asked.refinement.refine
    assert len(made.vertices) == 200


def test_an_illegal_keyword_is_told_like_any_option() -> None:
    points, normals = cloud_of("sphere")
    with pytest.raises(UsageError, match="`orient` is one of"):
        reconstruct(points, normals, orient="up")
    with pytest.raises(UsageError, match="is not a length"):
        reconstruct(points, normals, fill_holes="wide")


def test_a_cloud_is_taken_as_it_was_read() -> None:
    points, normals = cloud_of("torus")
    given = cleaned(from_arrays(np.vstack([points, points[:5]]), np.vstack([normals, normals[:5]])))
    made = reconstruct(given, options=options())
    assert_same_bytes(made, mesh_of("torus"))
    assert made.report.counts["dropped_duplicates"] == 5
    with pytest.raises(UsageError, match="brings its own normals"):
        reconstruct(given, normals)
