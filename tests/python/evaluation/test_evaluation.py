# SPDX-License-Identifier: GPL-3.0-or-later
"""Every score of distance against its closed form, or against another library."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, replace

import numpy as np
import pytest
from helpers.analytic_meshes import ELLIPSOID
from helpers.true_shapes import FEW, SAMPLES, Mesh, box, measured, sphere, square
from scipy.spatial import cKDTree

from hdpea import _core
from hdpea.errors import CannotReconstruct
from hdpea.evaluation.distances import distances_between
from hdpea.evaluation.evaluation import evaluate
from hdpea.evaluation.normalization import DIAGONAL, LONGEST_SIDE
from hdpea.evaluation.options import EvaluationOptions
from hdpea.evaluation.scores import Accuracy, Evaluation
from hdpea.evaluation.truth import truth_of_mesh, truth_of_points


def by_longest_side(evaluation: Evaluation) -> Accuracy:
    return evaluation.accuracy[LONGEST_SIDE.name]


def found(density: float, distance: float) -> float:
    """Return how many points of a plane have a random sample within a distance, for so many samples of each area."""
    return float(1 - np.exp(-density * np.pi * distance**2))


def test_the_floor_is_that_of_random_points() -> None:
    floor = by_longest_side(measured(sphere(), "sphere")).floor
    assert floor is not None
    density = SAMPLES / np.pi  # the diameter is 1
    assert floor.chamfer == pytest.approx(2 / (np.pi * density), rel=0.02)
    assert floor.f1 == pytest.approx(found(density, LONGEST_SIDE.f1_threshold), rel=0.02)
    assert floor.normal_consistency == pytest.approx(1, abs=0.002)


def test_the_truth_itself_is_at_the_floor_and_exact() -> None:
    accuracy = by_longest_side(measured(sphere(), "sphere"))
    assert accuracy.floor is not None
    assert accuracy.chamfer == pytest.approx(0, abs=1e-20)
    assert accuracy.hausdorff == pytest.approx(0, abs=1e-10)
    assert accuracy.samples.chamfer == pytest.approx(accuracy.floor.chamfer, rel=0.02)
    assert accuracy.samples.f1 == pytest.approx(accuracy.floor.f1, rel=0.02)


@pytest.mark.parametrize("height", [0.001, 0.05])
def test_parallel_squares_are_their_height_apart(height: float) -> None:
    accuracy = by_longest_side(measured(square(height)))
    assert accuracy.to_truth is not None
    for way in (accuracy.to_result, accuracy.to_truth):
        assert (way.rms, way.max) == (pytest.approx(height), pytest.approx(height))
    assert accuracy.chamfer == pytest.approx(2 * height**2)
    assert accuracy.samples.chamfer == pytest.approx(2 * (height**2 + 1 / (np.pi * SAMPLES)), rel=0.02)
    nearer = max(LONGEST_SIDE.f1_threshold**2 - height**2, 0) ** 0.5
    assert accuracy.samples.f1 == pytest.approx(found(SAMPLES, nearer), rel=0.03)


def test_largest_distances_are_found_at_vertices() -> None:
    margin = 0.01
    evaluation = measured(box(1 + 2 * margin), "box")
    accuracy, in_diagonals = by_longest_side(evaluation), evaluation.accuracy[DIAGONAL.name]
    assert accuracy.to_truth is not None
    assert accuracy.to_truth.max == pytest.approx(margin * 3**0.5)
    assert accuracy.to_result.max == pytest.approx(margin)
    assert accuracy.hausdorff == pytest.approx(margin * 3**0.5)
    assert in_diagonals.hausdorff == pytest.approx(margin)
    assert accuracy.chamfer is not None
    assert in_diagonals.chamfer == pytest.approx(accuracy.chamfer / 3)
    assert in_diagonals.samples.chamfer == pytest.approx(accuracy.samples.chamfer / 3)
    assert in_diagonals.samples.hausdorff == pytest.approx(accuracy.samples.hausdorff / 3**0.5)


def test_f1_is_the_harmonic_mean_of_what_is_found_either_way() -> None:
    accuracy = by_longest_side(measured(square(width=0.5)))
    within = LONGEST_SIDE.f1_threshold
    precision, recall = found(SAMPLES, within), found(2 * SAMPLES, within) / 2
    assert accuracy.samples.f1 == pytest.approx(2 * precision * recall / (precision + recall), rel=0.02)
    assert accuracy.to_result.rms == pytest.approx((0.5**3 / 3) ** 0.5, rel=0.02)
    assert accuracy.to_result.max == pytest.approx(0.5)


@pytest.mark.parametrize("tilt", [0.0, 0.3, -1.2])
def test_normals_are_consistent_by_their_cosine(tilt: float) -> None:
    samples = by_longest_side(measured(square(tilt=tilt))).samples
    assert samples.normal_consistency == pytest.approx(abs(np.cos(tilt)))


def test_sample_distances_are_those_of_another_library() -> None:
    one, other = np.random.default_rng(0).random((2, 3000, 3))
    distances = distances_between(one, None, other, None)
    np.testing.assert_allclose(distances.from_truth, cKDTree(other).query(one)[0])
    np.testing.assert_allclose(distances.from_result, cKDTree(one).query(other)[0])
    assert distances.hausdorff(2.0) == max(distances.from_truth.max(), distances.from_result.max()) / 2
    assert distances.normal_consistency is None


def test_scores_do_not_depend_on_the_frame() -> None:
    def moved(mesh: Mesh) -> Mesh:
        return 1000 * mesh[0] + [5e5, 3e6, 100], mesh[1]

    pairs = ((sphere(2), sphere(3)), (moved(sphere(2)), moved(sphere(3))))
    here, there = (evaluate(*result, truth_of_mesh(*truth, FEW)) for result, truth in pairs)
    assert there.units[LONGEST_SIDE.name] == pytest.approx(2000)
    assert there.units[DIAGONAL.name] == pytest.approx(2000 * 3**0.5)
    near, far = by_longest_side(here), by_longest_side(there)
    assert near.chamfer is not None
    assert far.chamfer == pytest.approx(near.chamfer, rel=1e-5)
    assert asdict(far.samples) == pytest.approx(asdict(near.samples), rel=1e-3)
    assert there.triangles.g == pytest.approx(here.triangles.g, abs=1e-3)


def test_scores_are_the_same_for_the_same_seed_and_any_number_of_threads() -> None:
    def scores(seed: int) -> str:
        options = EvaluationOptions(samples=2000, seed=seed)
        return json.dumps(evaluate(*sphere(2), truth_of_mesh(*sphere(3), options)).as_dict()["accuracy"])

    once = scores(0)
    _core.set_thread_limit(1)
    try:
        assert scores(0) == once
    finally:
        _core.set_thread_limit(0)
    assert scores(1) != once


def test_of_points_less_is_known() -> None:
    vertices, _ = sphere(5)
    evaluation, unoriented = (evaluate(*sphere(3), truth_of_points(vertices, n, FEW)) for n in (vertices, None))
    accuracy = by_longest_side(evaluation)
    assert accuracy.to_result == by_longest_side(unoriented).to_result
    assert (accuracy.floor, accuracy.to_truth, accuracy.chamfer, accuracy.hausdorff) == (None,) * 4
    assert evaluation.triangles.g is None
    assert accuracy.samples.normal_consistency == pytest.approx(1, abs=0.01)
    assert by_longest_side(unoriented).samples.normal_consistency is None
    points, _ = square(0.25)
    flat = by_longest_side(evaluate(*square(), truth_of_points(points, options=FEW)))
    assert (flat.to_result.rms, flat.to_result.max) == (0.25, 0.25)


def test_a_result_in_another_frame_is_noted() -> None:
    assert measured(square()).notes == ()
    vertices, faces = square()
    for elsewhere in (vertices + np.array([5, 0, 0]), 1000 * vertices):
        assert "same frame" in " ".join(measured((elsewhere, faces)).notes)


def test_surfaces_without_extent_are_refused() -> None:
    point = np.zeros((3, 3)), np.array([[0, 1, 2]])
    line = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), np.array([[0, 1, 2]])
    with pytest.raises(CannotReconstruct, match="truth are equal"):
        truth_of_mesh(*point)
    with pytest.raises(CannotReconstruct, match="no area"):
        truth_of_mesh(*line)
    with pytest.raises(CannotReconstruct, match="no area"):
        measured(line)


@dataclass(frozen=True)
class Baseline:
    """A score by the other implementation: mean over four seeds, and how far two seeds may differ."""

    value: float
    within: float


BASELINES = {
    "chamfer": Baseline(1.0731e-5, 0.02e-5),
    "f1": Baseline(0.8361, 0.006),
    "normal_consistency": Baseline(0.99805, 0.0001),
    "hausdorff": Baseline(0.731e-2, 0.03e-2),
}
BASELINES_IN_DIAGONALS = {
    "chamfer": Baseline(0.7060e-5, 0.013e-5),
    "f1": Baseline(0.9955, 0.001),
    "normal_consistency": Baseline(0.99805, 0.0001),
    "hausdorff": Baseline(0.593e-2, 0.025e-2),
}
EXACT_CHAMFER, EXACT_HAUSDORFF = Baseline(0.21707e-5, 0.002e-5), Baseline(0.28859e-2, 0.0001e-2)
G, G_ISOTROPIC = Baseline(0.6111, 0.003), Baseline(0.571924, 1e-6)
FLOOR_CHAMFER = Baseline(0.8627e-5, 0.015e-5)


def test_scores_agree_with_those_of_another_implementation() -> None:
    # benchmarks/evaluation_agreement.py prints them, and compares on real meshes too.
    coarse = replace(ELLIPSOID, regular=(40, 20)).mesh("regular")
    evaluation = evaluate(*coarse, truth_of_mesh(*ELLIPSOID.mesh("regular")))
    for normalization, wanted in ((LONGEST_SIDE, BASELINES), (DIAGONAL, BASELINES_IN_DIAGONALS)):
        scores = asdict(evaluation.accuracy[normalization.name].samples)
        for name, baseline in wanted.items():
            assert scores[name] == pytest.approx(baseline.value, abs=baseline.within)
    accuracy = by_longest_side(evaluation)
    assert accuracy.floor is not None
    for value, baseline in (
        (accuracy.chamfer, EXACT_CHAMFER),
        (accuracy.hausdorff, EXACT_HAUSDORFF),
        (accuracy.floor.chamfer, FLOOR_CHAMFER),
        (evaluation.triangles.g, G),
        (evaluation.triangles.g_isotropic, G_ISOTROPIC),
    ):
        assert value == pytest.approx(baseline.value, abs=baseline.within)
