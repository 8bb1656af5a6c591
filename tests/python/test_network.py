# SPDX-License-Identifier: GPL-3.0-or-later
"""The network: what it must not depend on."""

from __future__ import annotations

from dataclasses import replace

import clouds
import numpy as np
import pytest
import torch
from networks import TINY

from hdpea.errors import UsageError
from hdpea.network.clouds import Clouds
from hdpea.network.inference import predict_psi, sampling_scale
from hdpea.network.options import CONFIGURATIONS, NetworkOptions
from hdpea.network.transformer import PointTransformer

PLAIN = replace(TINY, stem=False, smoothing=0, normal_share=0.0)


@pytest.fixture(params=[TINY, PLAIN], ids=["stem", "plain"])
def network(request: pytest.FixtureRequest) -> PointTransformer:
    return PointTransformer(request.param).eval()


def unit_torus(count: int = 500, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    points, normals = clouds.torus(count, seed=seed)
    return points / np.linalg.norm(np.ptp(points, axis=0)), normals


def test_the_order_of_points_does_not_matter_to_the_last_bit(network: PointTransformer) -> None:
    points, normals = unit_torus()
    order = np.random.default_rng(1).permutation(len(points))
    np.testing.assert_array_equal(
        predict_psi(network, points[order], normals[order]), predict_psi(network, points, normals)[order]
    )


def test_the_order_within_the_network_matters_to_rounding_alone(network: PointTransformer) -> None:
    points, normals = unit_torus()
    order = np.random.default_rng(1).permutation(len(points))
    with torch.no_grad():
        psi, shuffled = network(Clouds.of(points, normals, 8)), network(Clouds.of(points[order], normals[order], 8))
    torch.testing.assert_close(shuffled, psi[order], rtol=0, atol=1e-5)


def test_where_the_cloud_lies_does_not_matter(network: PointTransformer) -> None:
    points, normals = unit_torus()
    psi = predict_psi(network, points, normals)
    np.testing.assert_allclose(predict_psi(network, points + np.array([1000, -20, 3]), normals), psi, rtol=0, atol=1e-5)


def test_a_batch_is_its_clouds(network: PointTransformer) -> None:
    parts = [Clouds.of(*unit_torus(count, seed=count), 8) for count in (500, 60, 300)]
    with torch.no_grad():
        together = network(Clouds.together(parts))
        apart = torch.cat([network(part) for part in parts])
    torch.testing.assert_close(together, apart, rtol=0, atol=1e-5)


def test_psi_scales_with_the_metric_of_the_scaled_cloud(network: PointTransformer) -> None:
    points, normals = unit_torus()
    scaled = predict_psi(network, points / 10, normals, scale=10)
    np.testing.assert_allclose(10 * scaled, predict_psi(network, points, normals, scale=1), rtol=0, atol=1e-5)


def test_clouds_are_scaled_to_a_sampling_that_is_known() -> None:
    points, _ = unit_torus(40_000)
    assert sampling_scale(points) == 1
    assert sampling_scale(points / 100) > 10
    assert sampling_scale(points * 100) < 0.1


def test_weights_start_from_the_seed_alone() -> None:
    first, second, other = (PointTransformer(replace(TINY, seed=seed)).state_dict() for seed in (1, 1, 2))
    assert all(torch.equal(first[name], second[name]) for name in first)
    assert not torch.equal(first["psi.weight"], other["psi.weight"])


def test_curves_are_shuffled_in_training_only() -> None:
    network, cloud = PointTransformer(TINY), Clouds.of(*unit_torus(), 8)
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
            name: sum(each.numel() for each in PointTransformer(options).parameters())
            for name, options in CONFIGURATIONS.items()
        }
    assert 1_000_000 <= sizes["compact"] <= 5_000_000
    assert 40_000_000 <= sizes["base"] <= 50_000_000


def test_too_few_points_are_refused() -> None:
    with pytest.raises(UsageError, match="too few"):
        predict_psi(PointTransformer(TINY), *unit_torus(8), scale=1)


@pytest.mark.parametrize("wrong", [{"depths": (1,)}, {"decoder_channels": (16, 16)}, {"channels": (17, 32)}])
def test_networks_that_do_not_fit_together_are_refused(wrong: dict[str, tuple[int, ...]]) -> None:
    with pytest.raises(UsageError):
        replace(TINY, **wrong)


def test_the_defaults_are_the_compact_configuration() -> None:
    assert NetworkOptions() == CONFIGURATIONS["compact"]
