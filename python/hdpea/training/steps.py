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
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.crops import Crop, Samples, crop_number
from hdpea.training.losses import FIT_NEIGHBORS, loss_parts
from hdpea.training.options import TrainingOptions
from hdpea.training.workers import Workers


class Training:
    """A network in training: every step is a function of the state before it only."""

    best: float | None = None
    """The best score of a validation so far."""

    half: bool
    """Whether the layers compute in bfloat16: a GPU is faster then, a CPU slower. Losses and fits are in float32."""

    def __init__(
        self, samples: Samples, network: NetworkOptions, options: TrainingOptions, workers: Workers | None = None
    ) -> None:
        self.samples, self.options, self.workers, self.step = samples, options, workers or Workers(), 0
        if not samples.names:
            raise UsageError("There is nothing to train on: the dataset has no samples.")
        if options.batch % self.workers.count:
            raise UsageError(f"A batch of {options.batch} cannot be shared evenly by {self.workers.count} processes.")
        self.metric = samples.metric.of_clouds()
        if not self.metric.scale > 0:
            raise UsageError("There is nothing to learn: the samples' metric has a scale of 0 and stretches nothing.")
        self.network = PointTransformer(network, self.metric).train().to(self.workers.device)
        self.shared = self.workers.share(self.network)
        self.averaged = {name: value.clone() for name, value in self.network.state_dict().items()}
        self.optimizer = torch.optim.AdamW(
            _groups(self.network, options), weight_decay=options.weight_decay, fused=True
        )
        per_epoch = math.ceil(len(samples.names) / options.batch)
        self.steps = options.steps if options.epochs is None else options.epochs * per_epoch
        self.half = self.workers.device.type == "cuda"
        self.neighbors = max(network.neighbors, options.loss.distance_neighbors, FIT_NEIGHBORS)

    def resume(self, checkpoint: Checkpoint) -> None:
        """Resume from a checkpoint of the same options; only the number of steps may differ.

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
        same_length = replace(checkpoint.training, steps=self.options.steps, epochs=self.options.epochs)
        if checkpoint.network != self.network.options or same_length != self.options:
            raise UsageError(
                "The checkpoint was made with other options.", "Use those, or another folder; only `steps` may change."
            )
        self.network.load_state_dict(checkpoint.weights)
        for name, value in self.averaged.items():
            value.copy_(checkpoint.averaged[name])
        self.optimizer.load_state_dict(checkpoint.optimizer)
        self.step, self.best = checkpoint.step, checkpoint.best

    def checkpoint(self) -> Checkpoint:
        """Return the state, to be written at once, since it is not copied."""
        weights, optimizer = self.network.state_dict(), self.optimizer.state_dict()
        return Checkpoint(
            self.network.options, self.options, self.metric, self.step, weights, self.averaged, optimizer, self.best
        )

    def crop(self, step: int) -> Crop:
        """Return this process's crops of a step."""
        options = self.options
        numbers = range(step * options.batch + self.workers.rank, (step + 1) * options.batch, self.workers.count)
        cut = [crop_number(number, self.samples, options.crops, self.neighbors, options.seed) for number in numbers]
        return Crop.together(cut)

    def run_step(self, crop: Crop) -> dict[str, float]:
        """Train on one batch; return the terms of its loss."""
        options = self.options
        torch.manual_seed(options.seed * 1_000_003 + self.step)  # for the curves' order
        share = learning_share(self.step, self.steps, options.warm_up)
        for group in self.optimizer.param_groups:
            group["lr"] = group["full_rate"] * share
        crop = crop.to(self.workers.device)
        with torch.autocast(self.workers.device.type, torch.bfloat16, enabled=self.half):
            psi = self.shared(crop.clouds)
        parts = loss_parts(psi.float(), crop.truth, options.loss)
        self.optimizer.zero_grad()
        torch.autograd.backward(parts["loss"])
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


def learning_share(step: int, steps: int, warm_up: int) -> float:
    """Return the share of the full learning rate: linear warm-up, then a cosine down to 0."""
    if step < warm_up:
        return (step + 1) / warm_up
    return (1 + math.cos(math.pi * (step - warm_up) / max(steps - warm_up, 1))) / 2


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
