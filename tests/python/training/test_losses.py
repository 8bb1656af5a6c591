# SPDX-License-Identifier: GPL-3.0-or-later
"""The losses: 0 at the truth, blind to the gauge where they should be, not to jitter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch
from helpers.networks import torus_sample
from torch import Tensor

from hdpea import _core
from hdpea.network.averaging import Neighborhoods, averaged, tangents
from hdpea.training.losses import Truth, loss_parts, metric_errors
from hdpea.training.options import LOSSES, LossOptions

GAUGE_FREE = ("local", "ndhde-mae", "ndhde-mse")


@pytest.fixture(scope="module")
def truth() -> Truth:
    sample = torus_sample(600)
    neighbors = _core.nearest_neighbors(np.asarray(sample.points, float), 40)
    arrays = map(torch.from_numpy, (sample.points, sample.normals, sample.psi, neighbors))
    return Truth(*arrays, torch.full((600,), 1 / 600))


def loss(psi: Tensor, truth: Truth, name: str) -> float:
    return loss_parts(psi, truth, LossOptions(loss=name))["loss"].item()


def jitter(like: Tensor, size: float) -> Tensor:
    return size * torch.randn(like.shape, generator=torch.Generator().manual_seed(0))


@pytest.mark.parametrize("name", LOSSES)
def test_the_truth_costs_nothing_and_the_more_is_wrong_the_more_it_costs(truth: Truth, name: str) -> None:
    assert loss(truth.psi, truth, name) == pytest.approx(0, abs=1e-5)
    costs = [loss(truth.psi * factor, truth, name) for factor in (1.0, 0.8, 0.5)]
    assert costs[0] < costs[1] < costs[2]


@pytest.mark.parametrize("name", LOSSES)
def test_only_pointwise_losses_see_the_gauge(truth: Truth, name: str) -> None:
    turn = torch.linalg.qr(torch.randn(5, 5, generator=torch.Generator().manual_seed(1))).Q
    cost = loss(truth.psi @ turn.T + 0.3, truth, name)
    assert cost == pytest.approx(0, abs=1e-3) if name in GAUGE_FREE else cost > 0.01


@pytest.mark.parametrize("name", LOSSES)
def test_gradients_are_finite_even_at_the_truth_and_at_nothing(truth: Truth, name: str) -> None:
    for start in (truth.psi, torch.zeros_like(truth.psi)):
        psi = start.clone().requires_grad_()
        torch.autograd.backward(loss_parts(psi, truth, LossOptions(loss=name))["loss"])
        assert psi.grad is not None
        assert psi.grad.isfinite().all()


def test_points_without_weight_do_not_count(truth: Truth) -> None:
    weights = torch.where(truth.points[:, 0] < 0, truth.weights, 0.0)
    far_away = (truth.points[:, 0] > 0.2)[:, None]
    psi = truth.psi + far_away * 1.0
    assert loss(psi, replace(truth, weights=weights), "local") == pytest.approx(0, abs=1e-5)


def test_jitter_is_put_down_to_flatness_and_hardly_to_the_metric(truth: Truth) -> None:
    parts = loss_parts(truth.psi + jitter(truth.psi, 0.02), truth, LossOptions())
    assert parts["flatness"] > 0.2
    assert parts["flatness"] > parts["metric"]


def test_what_is_flatter_than_the_truth_is_not_rewarded(truth: Truth) -> None:
    noisy = replace(truth, psi=truth.psi + jitter(truth.psi, 0.02))
    assert loss_parts(truth.psi, noisy, LossOptions())["flatness"] < 0.001


def flat_patch(random: torch.Generator) -> tuple[Tensor, Neighborhoods]:
    flat = torch.cat([torch.rand(200, 2, generator=random), torch.zeros(200, 1)], dim=1)
    normals = torch.tensor([[0.0, 0.0, 1.0]]).expand(200, 3)
    neighbors = torch.from_numpy(_core.nearest_neighbors(flat.double().numpy(), 16))
    return flat, Neighborhoods.of(flat, normals, neighbors)


def test_an_affine_psi_is_fitted_whole() -> None:
    random = torch.Generator().manual_seed(0)
    flat, around = flat_patch(random)
    jacobian = torch.randn(5, 3, generator=random)
    gradient, left = around.fit(flat @ jacobian.T)
    expected = (tangents(torch.tensor([[0.0, 0.0, 1.0]])) @ jacobian.T).expand_as(gradient)
    torch.testing.assert_close(gradient, expected, rtol=0.02, atol=0.02)
    assert left.max() < 0.02


def test_averages_leave_what_is_affine_alone_and_noise_not() -> None:
    random = torch.Generator().manual_seed(0)
    flat, around = flat_patch(random)
    averaging = around.averaging()
    affine, noise = flat @ torch.randn(3, 5, generator=random) + 1, torch.randn(200, 5, generator=random)
    torch.testing.assert_close(averaged(affine, around.members, averaging), affine, rtol=0, atol=0.01)
    assert averaged(noise, around.members, averaging).std() < 0.5 * noise.std()


def test_tangents_are_an_orthonormal_basis() -> None:
    normals = torch.nn.functional.normalize(torch.randn(100, 3, generator=torch.Generator().manual_seed(0)), dim=1)
    basis = torch.cat([tangents(normals), normals[:, None]], dim=1)
    torch.testing.assert_close(basis @ basis.mT, torch.eye(3).expand(100, 3, 3), rtol=0, atol=1e-5)


def test_twice_the_metric_is_as_wrong_as_half_of_it() -> None:
    gradient = torch.eye(2, 5)[None]  # the metric is 2
    none, more = torch.zeros_like(gradient), 3**0.5 * gradient  # 1 and 4
    torch.testing.assert_close(metric_errors(none, gradient), metric_errors(more, gradient))
    assert metric_errors(gradient, gradient).item() == pytest.approx(0, abs=1e-6)
