# SPDX-License-Identifier: GPL-3.0-or-later
"""The learned embedding as a stage: scale, thinning, and what it says when its weights are wrong."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from helpers import clouds
from helpers.networks import TINY, network_of

from hdpea import _core
from hdpea.embedding.embedded import Embedded
from hdpea.embedding.learned import embed_learned
from hdpea.errors import UsageError
from hdpea.geometry.interpolation import Interpolation
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.network.weights import write_weights
from hdpea.options import EmbeddingOptions, MeshingOptions, Options
from hdpea.reconstruction import reconstruct
from hdpea.surface.surface import Surface


@pytest.fixture(scope="module")
def weights(tmp_path_factory: pytest.TempPathFactory) -> str:
    path: Path = tmp_path_factory.mktemp("weights") / "tiny.safetensors"
    write_weights(path, network_of(TINY))
    return str(path)


def embedded(points: np.ndarray, normals: np.ndarray, vertices: int, weights: str | None = None) -> Embedded:
    frame = UnitFrame.around(points)
    surface = Surface.of(frame, frame.to_unit(points), normals)
    options = EmbeddingOptions(embedding="learned", weights=weights)
    return embed_learned(surface, vertices, options, lambda _: True)


def test_the_metric_is_that_of_the_budget_not_of_the_units(weights: str) -> None:
    points, normals = clouds.torus(3000)
    once, larger = (embedded(size * points, normals, 400, weights) for size in (1, 1000))
    np.testing.assert_allclose(once.coordinates, larger.coordinates, atol=1e-6)
    coarser = embedded(points, normals, 300, weights)
    assert not np.allclose(once.coordinates, coarser.coordinates, atol=1e-3)


def test_a_redundant_cloud_is_embedded_as_a_thinned_one_would_be() -> None:
    points, normals = clouds.torus(30_000)
    every_fourth = slice(None, None, 4)
    dense = embedded(points, normals, 700).coordinates[every_fourth, 3:]
    thin = embedded(points[every_fourth], normals[every_fourth], 700).coordinates[:, 3:]
    spread = np.linalg.norm(thin - thin.mean(axis=0), axis=1).mean()
    assert np.linalg.norm(dense - thin, axis=1).mean() < 0.2 * spread


def test_psi_is_interpolated_along_its_gradient() -> None:
    points, normals = clouds.sphere(4000)
    psi = 3 * points[:, [0, 1, 2, 0, 1]]
    others, other_normals = clouds.sphere(500, seed=7)
    interpolated = Interpolation.of(points, normals, others, other_normals)(psi)
    nearest = psi[_core.nearest_neighbors(points, others, 1)[:, 0]]
    errors, of_nearest = (
        np.linalg.norm(each - 3 * others[:, [0, 1, 2, 0, 1]], axis=1) for each in (interpolated, nearest)
    )
    assert errors.mean() < 0.1 * of_nearest.mean()


def test_psi_is_not_interpolated_through_a_wall() -> None:
    points, normals = clouds.hollow_sphere(8000, 1.0)
    psi = np.pad(normals, ((0, 0), (0, 2)))
    others, other_normals = points[::7] * 1.001, normals[::7]
    interpolated = Interpolation.of(points, normals, others, other_normals)(psi)
    assert np.linalg.norm(interpolated - psi[::7], axis=1).max() < 0.2


def test_reconstruction_by_a_network_that_knows_nothing_is_still_a_manifold(weights: str) -> None:
    options = Options(
        embedding=EmbeddingOptions(embedding="learned", weights=weights), meshing=MeshingOptions(vertices=300)
    )
    result = reconstruct(*clouds.torus(3000), options)
    assert result.report.mesh.manifold
    assert [each.name for each in result.report.choices if each.name == "metric_spacing"]


def test_weights_belong_to_the_learned_embedding_and_to_no_other() -> None:
    with pytest.raises(UsageError, match="no use for weights"):
        EmbeddingOptions(embedding="direct", weights="some.safetensors")
