# SPDX-License-Identifier: GPL-3.0-or-later
"""The network: what it must not depend on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch
from helpers import clouds
from helpers.networks import SPACING, TINY, cloud_of, neighbors_of, network_of, predicted, unit_torus

from hdpea.errors import UsageError
from hdpea.network.clouds import Clouds, moved_together, shape_operators
from hdpea.network.inference import predict_psi
from hdpea.network.layers import Linear
from hdpea.network.options import CONFIGURATIONS, NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.network.voxels import CELLS, Voxels

PLAIN = replace(TINY, stem=False, smoothing=0, normal_share=0.0)


def shape_of(matrix: np.ndarray) -> np.ndarray:
    return matrix[(0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)]


@pytest.fixture(params=[TINY, PLAIN], ids=["stem", "plain"])
def network(request: pytest.FixtureRequest) -> PointTransformer:
    return network_of(request.param).eval()


def test_the_order_of_points_does_not_matter_to_the_last_bit(network: PointTransformer) -> None:
    points, normals = unit_torus()
    order = np.random.default_rng(1).permutation(len(points))
    shuffled = predicted(network, points[order], normals[order])
    np.testing.assert_array_equal(shuffled, predicted(network, points, normals)[order])


@pytest.mark.parametrize("count", [40, 150, 2045])
def test_the_number_of_threads_does_not_matter_to_the_last_bit(network: PointTransformer, count: int) -> None:
    cloud, before, results = unit_torus(count), torch.get_num_threads(), []
    try:
        for threads in (1, 2, 3):
            torch.set_num_threads(threads)
            results.append(predicted(network, *cloud))
    finally:
        torch.set_num_threads(before)
    assert all(np.array_equal(results[0], each) for each in results[1:])


def test_the_number_of_threads_changes_no_product() -> None:
    rows, layer, before = 130, Linear(384, 192), torch.get_num_threads()
    x = torch.randn(rows, 384, generator=torch.Generator().manual_seed(0))
    try:
        results = []
        for threads in (1, 2, 3, 8):
            torch.set_num_threads(threads)
            results.append([layer(x[:count]) for count in range(1, rows, 3)])
    finally:
        torch.set_num_threads(before)
    assert all(torch.equal(*pair) for each in results[1:] for pair in zip(results[0], each, strict=True))


def test_the_order_within_the_network_matters_to_rounding_alone(network: PointTransformer) -> None:
    points, normals = unit_torus()
    order = np.random.default_rng(1).permutation(len(points))
    with torch.no_grad():
        psi, shuffled = network(cloud_of(points, normals)), network(cloud_of(points[order], normals[order]))
    torch.testing.assert_close(shuffled, psi[order], rtol=0, atol=1e-4)


def test_where_the_cloud_lies_does_not_matter(network: PointTransformer) -> None:
    points, normals = unit_torus()
    psi = predicted(network, points, normals)
    np.testing.assert_allclose(predicted(network, points + np.array([1000, -20, 3]), normals), psi, rtol=0, atol=1e-5)


def test_a_batch_is_its_clouds(network: PointTransformer) -> None:
    parts = [cloud_of(*unit_torus(count, seed=count)) for count in (500, 60, 300)]
    with torch.no_grad():
        together = network(Clouds.together(parts))
        apart = torch.cat([network(part) for part in parts])
    torch.testing.assert_close(together, apart, rtol=0, atol=1e-5)


def test_psi_scales_with_the_cloud_and_the_spacing(network: PointTransformer) -> None:
    points, normals = unit_torus()
    scaled = predicted(network, 16 * points, normals, 16 * SPACING)
    np.testing.assert_allclose(scaled / 16, predicted(network, points, normals), rtol=0, atol=1e-5)


def test_weights_start_from_the_seed_alone() -> None:
    first, second, other = (network_of(replace(TINY, seed=seed)).state_dict() for seed in (1, 1, 2))
    assert all(torch.equal(first[name], second[name]) for name in first)
    assert not torch.equal(first["psi.weight"], other["psi.weight"])


def test_curves_are_shuffled_in_training_only() -> None:
    network, cloud = network_of(TINY), cloud_of(*unit_torus())
    with torch.no_grad():
        network.train()
        torch.manual_seed(0)
        trained = [network(cloud) for _ in range(8)]
        network.eval()
        used = [network(cloud) for _ in range(2)]
    assert any(not torch.equal(each, trained[0]) for each in trained)
    assert torch.equal(*used)


def test_the_configurations_have_the_sizes_they_are_meant_to_have() -> None:
    with torch.device("meta"):
        sizes = {
            name: sum(each.numel() for each in network_of(options).parameters())
            for name, options in CONFIGURATIONS.items()
        }
    assert 1_000_000 <= sizes["compact"] <= 5_000_000
    assert 40_000_000 <= sizes["base"] <= 50_000_000


def test_the_shape_operator_of_a_sphere_is_its_curvature_across_the_normal() -> None:
    normals = clouds.sphere(4000)[1]
    xx, yy, zz, xy, xz, yz = shape_operators(5 * normals, normals, neighbors_of(5 * normals, normals)).T
    trace, through = xx + yy + zz, np.stack([xx, yy, zz, xy, xz, yz], axis=1) - shape_of(np.eye(3) / 5)
    np.testing.assert_allclose(trace, 2 / 5, rtol=0.02)
    expected = -np.einsum("ni,nj->nij", normals, normals) / 5
    np.testing.assert_allclose(through, np.stack([shape_of(each) for each in expected]), atol=0.01)


@pytest.mark.parametrize("wrong", [{"depths": (1,)}, {"decoder_channels": (16, 16)}, {"channels": (17, 32)}])
def test_networks_that_do_not_fit_together_are_refused(wrong: dict[str, tuple[int, ...]]) -> None:
    with pytest.raises(UsageError):
        replace(TINY, **wrong)


def test_the_defaults_are_the_compact_configuration() -> None:
    assert NetworkOptions() == CONFIGURATIONS["compact"]


def test_a_cloud_of_ordinary_size_is_not_moved() -> None:
    points = np.random.default_rng(0).normal(size=(100, 3)) * 1000
    assert moved_together(points) is points


@pytest.mark.parametrize("distance", [1e5, 1e9, 1e15])
def test_clusters_far_apart_keep_their_shape_and_do_not_meet(distance: float) -> None:
    random = np.random.default_rng(0)
    cluster = random.integers(0, 4, 400)
    centres = distance * random.normal(size=(4, 3))
    # Shapes that survive the rounding of such large coordinates.
    offsets = random.integers(0, 8, (400, 3)) / 2 if distance < 1e12 else np.zeros((400, 3))
    moved = moved_together(np.rint(centres)[cluster] + offsets)
    assert abs(moved).max() < 8192
    for each in range(4):
        within = moved[cluster == each] - offsets[cluster == each]
        np.testing.assert_allclose(within, np.broadcast_to(within[0], within.shape), atol=1e-6)
    apart = np.linalg.norm(moved[:, None] - moved[None], axis=2)[cluster[:, None] != cluster[None]]
    assert apart.min() > 60


@pytest.mark.parametrize("scale", [1e6, 1e12, 1e30])
def test_psi_is_finite_however_far_apart_points_are(network: PointTransformer, scale: float) -> None:
    random = np.random.default_rng(0)
    points = random.normal(size=(300, 3)) * scale ** random.random((300, 1))
    normals = random.normal(size=(300, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    psi = predict_psi(network, points, normals, neighbors_of(points, normals), 1.0, rounds=0)
    assert np.isfinite(psi).all()


def test_voxels_beyond_the_last_cell_wrap_around() -> None:
    cells = torch.tensor([[CELLS + 1, 5, -1], [1, 5, CELLS - 1], [0, 0, 0]])
    voxels, index = Voxels.holding(cells, torch.zeros(3, dtype=torch.int64))
    assert index.tolist() == [1, 1, 0]
    assert voxels.batch.tolist() == [0, 0]
    assert len(voxels.neighborhood[0]) == 2
