# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples as they are put together from the truth, which is stood in for by one in closed form."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from hdpea.dataset.augmentation import TRANSFORMS
from hdpea.dataset.build import Task, make_samples, seed_of
from hdpea.dataset.ground_truth import PointTruth
from hdpea.dataset.options import DatasetOptions
from hdpea.dataset.sample_file import decoded
from hdpea.dataset.sample_generation import make_sample
from hdpea.dataset.sources import Source
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options.settings import filled


class _Embedded:
    """A mesh on which psi starts with the point itself, so that a sample shows whom it belongs to."""

    def at(self, points: np.ndarray[Any, Any]) -> PointTruth:
        return PointTruth(np.pad(points, ((0, 0), (0, 2))), points[:, :2], np.roll(points, 1, axis=1))


@pytest.fixture(autouse=True)
def _stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("hdpea.dataset.sample_generation.embed_mesh", lambda *_: _Embedded())


@pytest.fixture
def ball() -> trimesh.Trimesh:
    return trimesh.creation.icosphere(subdivisions=3, radius=5).apply_translation([100, 0, 0])


def options(**chosen: Any) -> DatasetOptions:
    return filled(DatasetOptions, {"points": 500, **chosen})


@pytest.mark.parametrize("kind", ["area", "farthest", "scan"])
def test_the_truth_is_that_of_the_points_of_the_surface(kind: str, ball: trimesh.Trimesh) -> None:
    sample = make_sample(ball.vertices, ball.faces, options(kind=kind, noise=0.001), seed=1)
    np.testing.assert_array_equal(sample.psi[:, :3], sample.surface_points)
    np.testing.assert_array_equal(sample.embedding[:, 3:], sample.psi)
    radii = np.linalg.norm(sample.frame.to_world(sample.surface_points.astype(float)) - [100, 0, 0], axis=1)
    np.testing.assert_allclose(radii, 5, rtol=0.01)
    assert (np.einsum("nc,nc->n", sample.normals, sample.surface_points) > 0).all()
    assert (sample.sensors is not None) == (kind == "scan")
    assert np.array_equal(sample.points, sample.surface_points) == (kind != "scan")
    assert sample.frame.diagonal == UnitFrame.around(ball.vertices).diagonal
    assert {array.dtype for array in (sample.points, sample.psi, sample.curvatures)} == {np.dtype(np.float32)}


def test_the_seed_decides(ball: trimesh.Trimesh) -> None:
    one, same, other = (make_sample(ball.vertices, ball.faces, options(), seed).points for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, same)
    assert not np.array_equal(one, other)


def test_normals_are_estimated_if_asked_for(ball: trimesh.Trimesh) -> None:
    assert make_sample(ball.vertices, ball.faces, options(), 0).estimated_normals is None
    sample = make_sample(ball.vertices, ball.faces, options(estimate=True), 0)
    assert sample.estimated_normals is not None
    assert np.einsum("nc,nc->n", sample.estimated_normals, sample.normals).min() > 0.9


def test_a_release_holds_all_augmentations(ball: trimesh.Trimesh, tmp_path: Path) -> None:
    ball.export(tmp_path / "ball.ply")
    task = Task(Source("ball", "ball.ply", tmp_path / "ball.ply"), options(augmented=True), seed_of("ball", 0), 1)
    plain, *others = make_samples(task)
    assert plain.augmentation is None
    assert {each.augmentation for each in others} == set(TRANSFORMS) - {"identity"}
    points = decoded(plain.content).points
    for each in others:
        turned = decoded(each.content).points
        np.testing.assert_allclose(turned, points @ TRANSFORMS[str(each.augmentation)].T, atol=1e-6)
