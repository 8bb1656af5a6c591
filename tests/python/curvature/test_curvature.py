# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from helpers import clouds
from helpers.analytic_meshes import ELLIPSOID, TORUS, Analytic
from numpy.typing import NDArray

from hdpea import CurvatureTensors, estimate_curvature
from hdpea.curvature.from_embedding import estimate_from_embedding
from hdpea.curvature.from_jets import estimate_from_jets
from hdpea.curvature.options import CurvatureOptions, EstimationOptions
from hdpea.embedding import EMBEDDERS, embed_surface
from hdpea.embedding.embedded import Embedded
from hdpea.errors import CannotReconstruct, Interrupted, UsageError
from hdpea.geometry.metric import Metric
from hdpea.options import CleaningOptions, EmbeddingOptions, NormalOptions
from hdpea.surface.normals import oriented_surface

Array = NDArray[np.float64]
EMBEDDING, JET = (CurvatureOptions(EstimationOptions(method=method)) for method in ("embedding", "jet"))
METHODS = pytest.mark.parametrize("options", [EMBEDDING, JET], ids=["embedding", "jet"])


def degrees_between(a: Array, b: Array) -> Array:
    """Return the angles of lines, which have no sign."""
    return np.degrees(np.arccos(abs(np.einsum("nc,nc->n", a, b)).clip(0, 1)))


def metric_in_world(tensors: CurvatureTensors) -> Metric:
    options = EmbeddingOptions()
    diagonal = float(np.linalg.norm(np.ptp(tensors.points, axis=0)))
    return Metric(options.metric_scale * diagonal, options.max_stretch)


@METHODS
@pytest.mark.parametrize("surface", [TORUS, ELLIPSOID], ids=["torus", "ellipsoid"])
def test_directions_and_ratios_are_true(surface: Analytic, options: CurvatureOptions) -> None:
    points, normals = (clouds.torus if surface is TORUS else clouds.ellipsoid)(8_000)
    tensors = estimate_curvature(points, normals, options)
    curvatures, direction1 = surface.curvature(points)
    stretches = metric_in_world(tensors).stretches(curvatures)
    ratio = stretches[:, 0] / stretches[:, 1]
    assert tensors.determined[ratio > 1.5].mean() > 0.98
    sure = (ratio > 1.5) & tensors.determined
    assert np.median(degrees_between(tensors.direction1, direction1)[sure]) < 3
    assert np.median(abs(tensors.stretching_ratio / ratio - 1)) < 0.05


@METHODS
def test_curvatures_are_in_world_units(options: CurvatureOptions) -> None:
    points, normals = clouds.torus(8_000)
    tensors = estimate_curvature(10 * points, normals, options)
    truth = abs(TORUS.curvature(points)[0]) / 10
    low, high = tensors.curvature_range
    inside = ((truth > low) & (truth < high)).all(axis=1)
    assert inside.mean() > 0.5
    assert np.median(abs(abs(tensors.curvatures) / truth - 1)[inside]) < 0.1


def test_jets_have_signs() -> None:
    points, normals = clouds.torus(8_000)
    tensors = estimate_curvature(points, normals, JET)
    truth, _ = TORUS.curvature(points)
    clear = abs(truth[:, 1]) > 0.2
    assert tensors.signed
    assert (np.sign(tensors.curvatures) == np.sign(truth))[clear].all()
    keeping = replace(JET, normals=NormalOptions(orient="file"))
    inward = estimate_curvature(points, -normals, keeping)
    np.testing.assert_allclose(inward.curvatures, -tensors.curvatures, atol=1e-9)


@METHODS
def test_a_pipe_of_raw_points_is_curved_around_and_flat_along(options: CurvatureOptions) -> None:
    angle, height = np.random.default_rng(0).random((2, 4_000))
    pipe = np.column_stack([np.cos(clouds.TAU * angle), np.sin(clouds.TAU * angle), 4 * height])
    tensors = estimate_curvature(pipe, options=options)
    assert tensors.determined.mean() > 0.99
    assert np.median(abs(abs(tensors.curvatures[:, 0]) - 1)) < 0.1
    assert np.median(degrees_between(tensors.direction2, np.tile([0.0, 0, 1], (4_000, 1)))) < 2


@METHODS
def test_what_is_flat_or_round_has_no_directions(options: CurvatureOptions) -> None:
    flat = np.column_stack([np.random.default_rng(0).random((2_000, 2)), np.zeros(2_000)])
    for cloud in (flat, clouds.sphere(4_000)[0]):
        tensors = estimate_curvature(cloud, options=options)
        assert tensors.determined.mean() < 0.05
        assert not tensors.direction1[~tensors.determined].any()
        assert not tensors.direction2[~tensors.determined].any()
        assert any("flat or round" in note for note in tensors.notes)


def test_jets_do_not_take_noise_for_directions() -> None:
    random = np.random.default_rng(0)
    rough = np.column_stack([random.random((4_000, 2)), random.normal(0, 0.002, 4_000)])
    # At the border, where all neighbours lie to one side, the error is underestimated.
    inside = (abs(rough[:, :2] - 0.5) < 0.3).all(axis=1)
    assert estimate_curvature(rough, options=JET).determined[inside].mean() < 0.05


def test_the_embedding_does_not_take_noise_for_directions() -> None:
    random = np.random.default_rng(0)
    rough = np.column_stack([random.random((4_000, 2)), random.normal(0, 0.004, 4_000)])
    inside = (abs(rough[:, :2] - 0.5) < 0.4).all(axis=1)
    assert estimate_curvature(rough).determined[inside].mean() < 0.05


def test_the_embedding_meets_noise_with_more_neighbors_of_the_normals() -> None:
    points, _ = clouds.torus(8_000)
    noisy = points + np.random.default_rng(1).normal(0, 0.02, points.shape)
    # So that each is the tensor of its point.
    kept = replace(EMBEDDING, cleaning=CleaningOptions(outliers="none"))
    tensors = estimate_curvature(noisy, options=kept)
    assert next(choice.value for choice in tensors.choices if choice.name == "normal_neighbors") > 60
    told = estimate_curvature(noisy, options=replace(kept, normals=NormalOptions(normal_neighbors=16)))
    assert all(choice.name != "normal_neighbors" for choice in told.choices)
    direction1 = TORUS.curvature(points)[1]
    steady, plain = (
        np.median(degrees_between(each.direction1, direction1)[each.determined]) for each in (tensors, told)
    )
    assert steady < 5 < plain


def test_jets_tell_the_radius_that_they_are_fitted_in() -> None:
    points, normals = clouds.sphere(4_000)
    radius = next(
        each.value for each in estimate_curvature(10 * points, normals, JET).choices if each.name == "jet_radius"
    )
    assert radius == pytest.approx(10 * np.sqrt(4 * 24 / 4_000), rel=0.1)  # a cap of as large an area as 24 points have


def test_jets_meet_noise_with_more_neighbors() -> None:
    points, normals = clouds.torus(8_000)
    noisy = points + np.random.default_rng(1).normal(0, 0.01, points.shape)
    tensors = estimate_curvature(noisy, normals, JET)
    assert tensors.choices[-1].value > 60
    assert np.median(degrees_between(tensors.direction1, TORUS.curvature(points)[1])[tensors.determined]) < 5


@METHODS
def test_both_sides_of_a_thin_wall_are_what_they_are(options: CurvatureOptions) -> None:
    points, normals = clouds.hollow_sphere(8_000, spacings_thick=2)
    tensors = estimate_curvature(points, normals, options)
    assert np.median(abs(abs(tensors.curvatures) - 1)) < 0.2


@METHODS
def test_the_metric_has_the_stretches_along_the_directions(options: CurvatureOptions) -> None:
    tensors = estimate_curvature(*clouds.torus(2_000), options)
    sure, metric = tensors.determined, tensors.metric

    def along(direction: Array) -> Array:
        return np.asarray(np.einsum("ni,nij,nj->n", direction, metric, direction))

    np.testing.assert_allclose(along(tensors.normals), 1)
    np.testing.assert_allclose(along(tensors.direction1)[sure], tensors.stretches[sure, 0] ** 2)
    np.testing.assert_allclose(along(tensors.direction2)[sure], tensors.stretches[sure, 1] ** 2)
    assert (tensors.stretching_ratio >= 1).all()
    frames = np.stack([tensors.direction1, tensors.direction2, tensors.normals], axis=1)[sure]
    np.testing.assert_allclose(frames @ frames.swapaxes(1, 2), np.tile(np.eye(3), (sure.sum(), 1, 1)), atol=1e-9)


@METHODS
def test_scale_and_shift_change_units_only(options: CurvatureOptions) -> None:
    points, normals = clouds.torus(2_000)
    here = estimate_curvature(points, normals, options)
    there = estimate_curvature(1024 * points + [2.0**20, 0, 2.0**22], normals, options)
    np.testing.assert_allclose(there.curvatures, here.curvatures / 1024, rtol=1e-5, atol=1e-8)
    np.testing.assert_allclose(there.metric, here.metric, rtol=1e-4, atol=1e-5)
    assert (there.determined == here.determined).mean() > 0.999


def test_jets_turn_with_the_cloud_and_know_no_order() -> None:
    points, normals = clouds.torus(2_000)
    rotation, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))
    rotation *= np.sign(np.linalg.det(rotation))
    order = np.random.default_rng(1).permutation(len(points))
    here = estimate_curvature(points, normals, JET)
    there = estimate_curvature(points[order] @ rotation.T, normals[order] @ rotation.T, JET)
    # The metric is in units of the bounding box, which does not turn with the cloud.
    np.testing.assert_allclose(there.curvatures, here.curvatures[order], rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(degrees_between(there.direction1, here.direction1[order] @ rotation.T), 0, atol=1e-3)


@METHODS
def test_any_number_of_threads_gives_the_same_bytes(options: CurvatureOptions) -> None:
    cloud = clouds.torus(2_000)
    one, two = (estimate_curvature(*cloud, replace(options, threads=threads)) for threads in (1, 2))
    assert one.metric.tobytes() == two.metric.tobytes()
    assert one.curvatures.tobytes() == two.curvatures.tobytes()


@METHODS
def test_the_paper_s_six_neighbors_are_to_be_had(options: CurvatureOptions) -> None:
    points, normals = clouds.torus(8_000)
    six = replace(options, estimation=replace(options.estimation, neighbors=6))
    tensors = estimate_curvature(points, normals, six)
    assert np.median(degrees_between(tensors.direction1, TORUS.curvature(points)[1])[tensors.determined]) < 5


def test_points_without_neighbors_are_unknown() -> None:
    surface = oriented_surface(*clouds.torus(1_000)).surface
    embedded = embed_surface(surface, 125, EmbeddingOptions())
    surface.neighbors[:3, 2:] = -1
    for estimate in (
        estimate_from_embedding(surface, embedded, None),
        estimate_from_jets(surface, Metric(0.5, 8), 24),
    ):
        assert np.isnan(estimate.curvatures[:3]).all()
        assert np.isnan(estimate.stretches[:3]).all()
        assert not estimate.determined[:3].any()
        assert np.isfinite(estimate.stretches[3:]).all()


def test_an_embedder_that_does_not_say_its_metric_gives_no_curvature(monkeypatch: pytest.MonkeyPatch) -> None:
    known = EMBEDDERS["direct"]
    monkeypatch.setitem(EMBEDDERS, "direct", lambda *arguments: Embedded(known(*arguments).coordinates))
    tensors = estimate_curvature(*clouds.torus(1_000))
    assert np.isnan(tensors.curvatures).all()
    assert np.isfinite(tensors.stretches).all()


def test_progress_tells_the_phases_and_can_stop() -> None:
    told: list[str] = []
    estimate_curvature(*clouds.torus(1_000), progress=lambda phase, _: told.append(phase) is None)
    changes = [told[0], *(after for before, after in pairwise(told) if before != after)]
    assert changes == ["normals", "embedding", "curvature"]
    with pytest.raises(Interrupted):
        estimate_curvature(*clouds.torus(1_000), progress=lambda phase, _: phase != "curvature")


@METHODS
def test_tensors_of_thinned_clouds_are_interpolated(options: CurvatureOptions, monkeypatch: pytest.MonkeyPatch) -> None:
    points, normals = clouds.torus(16_000)
    monkeypatch.setattr("hdpea.curvature.estimation.MOST_POINTS", 8_000)
    tensors = estimate_curvature(points, normals, options)
    assert [choice.value for choice in tensors.choices if choice.name == "estimated_at"] == [8_000]
    assert len(tensors.metric) == 16_000
    curvatures, direction1 = TORUS.curvature(points)
    low, _ = tensors.curvature_range
    inside = (abs(curvatures) > max(low, 0.1)).all(axis=1)
    assert np.median(abs(abs(tensors.curvatures) / abs(curvatures) - 1)[inside]) < 0.1
    assert np.percentile(degrees_between(tensors.normals, normals), 99) < 2
    assert tensors.determined.mean() > 0.99
    assert np.median(degrees_between(tensors.direction1, direction1)[tensors.determined]) < 1
    np.testing.assert_allclose(np.linalg.norm(tensors.direction1[tensors.determined], axis=1), 1)


def test_more_vertices_than_the_default_thin_less(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.curvature.estimation.MOST_POINTS", 1_000)
    fine = replace(JET, estimation=replace(JET.estimation, vertices=250))
    tensors = estimate_curvature(*clouds.torus(3_000), fine)
    assert [choice.value for choice in tensors.choices if choice.name == "estimated_at"] == [2_000]


def test_what_cannot_be_estimated_is_refused() -> None:
    with pytest.raises(CannotReconstruct, match="too few"):
        estimate_curvature(clouds.sphere(8)[0])
    with pytest.raises(UsageError, match="`neighbors` is at least 6"):
        EstimationOptions(neighbors=5)
    with pytest.raises(UsageError, match="`method` is one of"):
        EstimationOptions(method="magic")
    with pytest.raises(UsageError, match="scale 0"):
        CurvatureOptions(embedding=EmbeddingOptions(metric_scale=0))


def test_points_on_scan_lines_get_tensors_and_strays_do_not() -> None:
    angle = np.linspace(0, 2 * np.pi, 600, endpoint=False)
    height, around = np.meshgrid(np.arange(0, 6, 0.2), angle, indexing="ij")
    pipe = np.column_stack([np.cos(around).ravel(), np.sin(around).ravel(), height.ravel()])
    tensors = estimate_curvature(np.vstack([pipe, [[30.0, 0.0, 0.0]]]), options=JET)
    assert 0.99 * len(pipe) < len(tensors.points) <= len(pipe)
    inside = (tensors.points[:, 2] > 0.8) & (tensors.points[:, 2] < 5)
    assert np.median(tensors.curvatures[inside, 0]) == pytest.approx(1, rel=0.1)
    assert any("lie on no surface" in note for note in tensors.notes)
