# SPDX-License-Identifier: GPL-3.0-or-later
"""Losses of a predicted psi; each is a weighted mean over the points, and 0 at the truth.

The distance, metric and flatness terms are invariant to rotations and shifts of psi; the pointwise errors are not.
Distances alone reward noise: a network that does not yet know where to stretch matches them on average by making psi
noisy, which ruins the mesh. So the ``local`` loss is first-order: it compares the metric that the best affine map of
psi induces, which noise does not affect, and penalises the noise (the residual of that map) separately.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import torch
from torch import Tensor

from hdpea.network.averaging import Neighborhoods
from hdpea.network.layers import rows
from hdpea.training.options import LossOptions

FIT_NEIGHBORS = 16
"""Nearest points to which the local metric is fitted."""


@dataclass
class Truth:
    """The ground truth at n points; lengths are in spacings.

    Attributes
    ----------
    points
        (n, 3) float32 on the surface.
    normals
        (n, 3) float32, unit.
    psi
        (n, 5) float32.
    neighbors
        (n, k) int64: nearest points, nearest first.
    weights
        (n,) float32, summing to 1: the weight of each point in the loss.
    """

    points: Tensor
    normals: Tensor
    psi: Tensor
    neighbors: Tensor
    weights: Tensor

    def to(self, device: torch.device) -> Truth:
        """Return the truth on a device."""
        return Truth(*(getattr(self, each.name).to(device) for each in fields(self)))


def distance_errors(psi: Tensor, truth: Truth, neighbors: int) -> tuple[Tensor, Tensor]:
    """Return the errors (n, k) of distances in R^8 to the nearest `neighbors`, and the true distances (n, k).

    Both embeddings begin with the true points, so that noise on the points is not attributed to psi.
    """
    nearest = truth.neighbors[:, :neighbors]
    squared_in_space = _squared_distances(truth.points, nearest)  # (n, k)
    predicted = (squared_in_space + _squared_distances(psi, nearest)).sqrt()
    true = (squared_in_space + _squared_distances(truth.psi, nearest)).sqrt()
    return predicted - true, true


def metric_errors(gradient: Tensor, true_gradient: Tensor) -> Tensor:
    """Return the distance (n,) between the metrics induced by gradients of psi (n, 2, 5) along two tangents.

    The root of Jeffreys' divergence: with l the stretches of one metric relative to the other, the root of
    sum (l + 1/l) / 2 - 1; about |log l| where they are close, and equal for factors of two and one half.
    """
    metric, true = _metric(gradient), _metric(true_gradient)
    apart = metric - true
    # tr(A^-1 B) + tr(B^-1 A) - 4 = tr(A^-1 (A - B) B^-1 (A - B)), which avoids cancellation.
    product = (_adjugate(metric) @ apart) * (_adjugate(true) @ apart).mT
    divergence: Tensor = product.sum(dim=(1, 2)) / (2 * _determinant(metric) * _determinant(true))
    # The root of 0 has no gradient.
    floor = 1e-4
    return (divergence.clamp_min(0) + floor**2).sqrt() - floor


def loss_parts(psi: Tensor, truth: Truth, options: LossOptions) -> dict[str, Tensor]:
    """Return the loss and, detached, its terms.

    Parameters
    ----------
    psi
        (n, 5) predicted.

    Returns
    -------
    Scalars: ``loss``; ``distance`` (mean error over mean true distance), ``metric``, ``flatness``.
    """
    errors, true_distances = distance_errors(psi, truth, options.distance_neighbors)
    around = Neighborhoods.of(truth.points, truth.normals, truth.neighbors[:, :FIT_NEIGHBORS])
    gradient, residual = around.fit(psi)
    true_gradient, true_residual = around.fit(truth.psi)

    def mean(each: Tensor) -> Tensor:
        return (each * truth.weights).sum()

    scale = mean(true_distances.mean(dim=1)).clamp_min(1e-12)
    distance = mean(errors.abs().mean(dim=1)) / scale
    metric = mean(metric_errors(gradient, true_gradient))
    # Only what exceeds the truth counts: psi bends at sharp edges.
    flatness = mean((residual - true_residual).clamp_min(0))
    apart = psi - truth.psi
    losses = {
        "local": options.metric_weight * metric
        + options.flatness_weight * flatness
        + options.distance_weight * distance,
        "ndhde-mae": distance,
        "ndhde-mse": mean(errors.square().mean(dim=1)) / scale**2,
        "point-mse": mean(apart.square().sum(dim=1)),
        "point-mae": mean(apart.abs().sum(dim=1)),
    }
    parts = {"distance": distance, "metric": metric, "flatness": flatness}
    return {"loss": losses[options.loss]} | {name: value.detach() for name, value in parts.items()}


def _squared_distances(values: Tensor, neighbors: Tensor) -> Tensor:
    """Return the squared distances (n, k) of values (n, c) to their neighbours (n, k)."""
    # The root of 0 has no gradient; points closer than 1e-6 spacings are the same.
    return (rows(values, neighbors) - values[:, None]).square().sum(dim=2) + 1e-12


def _adjugate(a: Tensor) -> Tensor:
    """Return the inverse times the determinant of symmetric matrices (n, 2, 2)."""
    return torch.stack([a[:, 1, 1], -a[:, 0, 1], -a[:, 0, 1], a[:, 0, 0]], dim=1).view(-1, 2, 2)


def _determinant(a: Tensor) -> Tensor:
    return a[:, 0, 0] * a[:, 1, 1] - a[:, 0, 1].square()


def _metric(gradient: Tensor) -> Tensor:
    return torch.eye(2, device=gradient.device) + gradient @ gradient.mT
