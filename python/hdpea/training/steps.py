# SPDX-License-Identifier: GPL-3.0-or-later
"""A network in training, step by step."""

from __future__ import annotations

import math
from dataclasses import replace

import torch
from torch import Tensor, nn

from hdpea.errors import UsageError
from hdpea.network.layers import PatchAttention
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.runtime.pytorch import torch_device
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.crops import Crop, Samples
from hdpea.training.loaders import StepCrops
from hdpea.training.losses import FIT_NEIGHBORS, loss_parts
from hdpea.training.options import TrainingOptions
from hdpea.training.workers import Workers

ENDLESS = 10**9
"""Steps of a training that ends by the clock: more than it will ever do."""

CHANGEABLE = ("steps", "epochs", "minutes", "save_minutes", "loaders", "device")
"""What may differ when a training is resumed: how long it is, and what only the machine decides."""


class Training:
    """A network in training: every step is a function of the state before it only."""

    best: float | None = None
    """The best score of a validation so far."""

    half: bool
    """Whether the layers compute in bfloat16: a GPU is faster then, a CPU slower. Losses and fits are in float32."""

    seconds: float = 0.0
    """Spent on it so far, where its length is in minutes; those of earlier runs included."""

    def __init__(
        self, samples: Samples, network: NetworkOptions, options: TrainingOptions, workers: Workers | None = None
    ) -> None:
        self.options, self.step = options, 0
        self.workers = workers or Workers(device=torch_device(options.device))
        if not samples.names:
            raise UsageError("There is nothing to train on: the dataset has no samples.")
        if options.batch % self.workers.count:
            raise UsageError(f"A batch of {options.batch} cannot be shared evenly by {self.workers.count} processes.")
        self.metric = samples.metric.of_clouds()
        if not self.metric.scale > 0:
            raise UsageError("There is nothing to learn: the samples' metric has a scale of 0 and stretches nothing.")
        self.network = PointTransformer(network, self.metric).train().to(self.workers.device)
        self.averaged = {name: value.clone() for name, value in self.network.state_dict().items()}
        self.optimizer = torch.optim.AdamW(
            _groups(self.network, options), weight_decay=options.weight_decay, fused=True
        )
        per_epoch = math.ceil(len(samples.names) / options.batch)
        self.steps = options.steps if options.epochs is None else options.epochs * per_epoch
        self.half = self.workers.device.type == "cuda"
        if options.minutes is not None:
            self.steps = ENDLESS
        neighbors = max(network.neighbors, options.loss.distance_neighbors, FIT_NEIGHBORS)
        self.crops = StepCrops(samples, options, neighbors, self.workers.rank, self.workers.count)

    @property
    def done(self) -> float:
        """The share of the training that is done, after the warm-up; 1 at its end."""
        if self.options.minutes is not None:
            return min(self.seconds / max(60 * self.options.minutes, 1e-9), 1.0)
        warm_up = min(self.options.warm_up, self.steps - 1)
        return max(self.step - warm_up, 0) / (self.steps - warm_up)

    def start_from(self, network: PointTransformer) -> None:
        """Take over the weights of a trained network, in place of random ones.

        Raises
        ------
        UsageError
            If it has another shape, or was trained on another metric.
        """
        if network.options != self.network.options or network.metric != self.metric:
            raise UsageError(
                "The weights to start from are of another network or another metric.",
                "Those of the training are the options of the network and of the dataset.",
            )
        self.network.load_state_dict(network.state_dict())
        self.averaged = {name: value.clone() for name, value in self.network.state_dict().items()}

    def resume(self, checkpoint: Checkpoint) -> None:
        """Resume from a checkpoint of the same options; only its length and what it runs on may differ.

        Raises
        ------
        UsageError
            If its options, or the metric of its samples, are others.
        """
        if checkpoint.metric != self.metric:
            raise UsageError(
                "The checkpoint was trained on samples of another metric.",
                "Use a dataset that was built with the same ground truth, or another folder.",
            )
        as_now = replace(checkpoint.training, **{name: getattr(self.options, name) for name in CHANGEABLE})
        if checkpoint.network != self.network.options or as_now != self.options:
            raise UsageError(
                "The checkpoint was made with other options.",
                f"Use those, or another folder; only {', '.join(f'`{name}`' for name in CHANGEABLE)} may change.",
            )
        self.network.load_state_dict(checkpoint.weights)
        for name, value in self.averaged.items():
            value.copy_(checkpoint.averaged[name])
        self.optimizer.load_state_dict(checkpoint.optimizer)
        self.step, self.best, self.seconds = checkpoint.step, checkpoint.best, checkpoint.seconds

    def checkpoint(self) -> Checkpoint:
        """Return the state, to be written at once, since it is not copied."""
        weights, optimizer = self.network.state_dict(), self.optimizer.state_dict()
        return Checkpoint(
            self.network.options,
            self.options,
            self.metric,
            self.step,
            weights,
            self.averaged,
            optimizer,
            self.best,
            self.seconds,
        )

    def run_step(self, crop: Crop) -> dict[str, float]:
        """Train on one batch; return the terms of its loss."""
        options = self.options
        torch.manual_seed(options.seed * 1_000_003 + self.step)  # for the curves' order
        share = learning_share(self.step, options.warm_up, self.done)
        for group in self.optimizer.param_groups:
            group["lr"] = group["full_rate"] * share
        crop = crop.to(self.workers.device)
        with torch.autocast(self.workers.device.type, torch.bfloat16, enabled=self.half):
            psi = self.network(crop.clouds)
        parts = loss_parts(psi.float(), crop.truth, options.loss)
        self.optimizer.zero_grad()
        torch.autograd.backward(parts["loss"])
        self.workers.average_gradients(self.network)
        norm = nn.utils.clip_grad_norm_(self.network.parameters(), options.clip or math.inf)
        # One bad crop must not spoil hours of training.
        if torch.isfinite(norm):
            self.optimizer.step()
        self.step += 1
        self._average()
        return {name: value.item() for name, value in parts.items()} | {"gradient": norm.item()}

    def _average(self) -> None:
        # A shorter average at first, so that the initial weights are soon forgotten.
        share = min(self.options.average, (1 + self.step) / (10 + self.step))
        for name, value in self.network.state_dict().items():
            self.averaged[name].lerp_(value, 1 - share)

    def averaged_network(self) -> PointTransformer:
        """Return the network with averaged weights."""
        return self.checkpoint().build()


def learning_share(step: int, warm_up: int, done: float) -> float:
    """Return the share of the full learning rate: linear warm-up, then a cosine down to 0 where all is `done`."""
    return min((step + 1) / max(warm_up, 1), 1.0) * (1 + math.cos(math.pi * done)) / 2


def _groups(network: PointTransformer, options: TrainingOptions) -> list[dict[str, object]]:
    """Return the parameter groups of the attention modules and of the rest, each with its learning rate."""
    attention = {
        id(parameter)
        for module in network.modules()
        if isinstance(module, PatchAttention)
        for parameter in module.parameters()
    }
    groups: list[list[Tensor]] = [[], []]
    for parameter in network.parameters():
        groups[id(parameter) in attention].append(parameter)
    rates = (options.learning_rate, options.attention_rate)
    return [{"params": each, "lr": rate, "full_rate": rate} for each, rate in zip(groups, rates, strict=True)]
