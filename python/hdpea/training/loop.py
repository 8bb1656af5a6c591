# SPDX-License-Identifier: GPL-3.0-or-later
"""The training loop."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import torch
from torch import Tensor, nn

from hdpea.errors import Interrupted, UsageError
from hdpea.network.layers import PatchAttention
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.crops import Crop, Samples, crop_number
from hdpea.training.losses import loss_parts
from hdpea.training.options import TrainingOptions
from hdpea.training.validation import validate

LAST, BEST, METRICS = "last.pt", "best.pt", "metrics.jsonl"
"""The files of a training: to go on from, to use, to look at."""


class Training:
    """A network in training: every step is a function of the state before it and of nothing else."""

    def __init__(self, samples: Samples, network: NetworkOptions, options: TrainingOptions) -> None:
        self.samples, self.options = samples, options
        self.step, self.best = 0, None
        self.network = PointTransformer(network).train()
        self.averaged = {name: value.clone() for name, value in self.network.state_dict().items()}
        self.optimizer = torch.optim.AdamW(_groups(self.network, options), weight_decay=options.weight_decay)
        per_epoch = math.ceil(len(samples.names) / options.batch)
        self.steps = options.steps if options.epochs is None else options.epochs * per_epoch
        most = max(network.stem_neighbors, options.loss.distance_neighbors)
        self.neighbors = max(most, 16)

    best: float | None

    def resume(self, checkpoint: Checkpoint) -> None:
        """Go on from a checkpoint of the same options; the number of steps may be another.

        Raises
        ------
        UsageError
            If its options are others.
        """
        same_length = replace(checkpoint.training, steps=self.options.steps, epochs=self.options.epochs)
        if checkpoint.network != self.network.options or same_length != self.options:
            raise UsageError(
                "The checkpoint was made with other options.", "Use those, or another folder; only --steps may change."
            )
        self.network.load_state_dict(checkpoint.weights)
        self.averaged = checkpoint.averaged
        self.optimizer.load_state_dict(checkpoint.optimizer)
        self.step, self.best = checkpoint.step, checkpoint.best

    def checkpoint(self) -> Checkpoint:
        """Return the state, for writing at once: it is not copied."""
        weights, optimizer = self.network.state_dict(), self.optimizer.state_dict()
        return Checkpoint(
            self.network.options, self.options, self.step, weights, self.averaged, optimizer, self.best
        )

    def crop(self, step: int) -> Crop:
        """Return the crops of a step."""
        options = self.options
        numbers = range(step * options.batch, (step + 1) * options.batch)
        cut = [crop_number(number, self.samples, options.crops, self.neighbors, options.seed) for number in numbers]
        return Crop.together(cut)

    def run_step(self, crop: Crop) -> dict[str, float]:
        """Learn from one batch; return the parts of its loss."""
        options = self.options
        torch.manual_seed(options.seed * 1_000_003 + self.step)  # for the curves' order
        share = learning_share(self.step, self.steps, options.warm_up)
        for group in self.optimizer.param_groups:
            group["lr"] = group["full_rate"] * share
        parts = loss_parts(self.network(crop.clouds), crop.truth, options.loss)
        self.optimizer.zero_grad()
        parts["loss"].backward()
        norm = nn.utils.clip_grad_norm_(self.network.parameters(), options.clip or math.inf)
        # One bad crop must not spoil hours.
        if torch.isfinite(norm):
            self.optimizer.step()
        self.step += 1
        self._average()
        return {name: value.item() for name, value in parts.items()} | {"gradient": norm.item()}

    def _average(self) -> None:
        # Shorter at first, when the weights of the start are best forgotten.
        share = min(self.options.average, (1 + self.step) / (10 + self.step))
        for name, value in self.network.state_dict().items():
            self.averaged[name].lerp_(value, 1 - share)

    def averaged_network(self) -> PointTransformer:
        """Return the network with averaged weights."""
        return self.checkpoint().build()


def learning_share(step: int, steps: int, warm_up: int) -> float:
    """Return the share of the full learning rate: rising, then falling as a cosine to 0."""
    if step < warm_up:
        return (step + 1) / warm_up
    return (1 + math.cos(math.pi * (step - warm_up) / max(steps - warm_up, 1))) / 2


def _groups(network: PointTransformer, options: TrainingOptions) -> list[dict[str, object]]:
    """Return the parameters of attention modules and the others, each with its learning rate."""
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


def train(
    samples: Samples,
    validation: Samples | None,
    out: Path,
    network: NetworkOptions,
    options: TrainingOptions,
    stopped: Callable[[], bool] = lambda: False,
) -> Training:
    """Train a network, or go on where the folder `out` says that a training was stopped.

    Parameters
    ----------
    samples, validation
        What is trained on, and what is reconstructed every so often to choose the best weights.
    out
        A folder for ``last.pt``, ``best.pt`` and ``metrics.jsonl``.
    stopped
        Asked between steps; True ends the training with a checkpoint and ``Interrupted``.
    """
    torch.set_num_threads(options.threads)
    training = Training(samples, network, options)
    last = out / LAST
    if last.exists():
        training.resume(Checkpoint.read(last))
    saved, logged, since = time.monotonic(), time.monotonic(), training.step
    sums: dict[str, float] = {}
    for crop in _prefetched(training):
        for name, value in training.run_step(crop).items():
            sums[name] = sums.get(name, 0.0) + value
        step, now = training.step, time.monotonic()
        if step % options.log_every == 0:
            count = step - since
            means = {name: value / count for name, value in sums.items()}
            _log(out, {"step": step, "seconds_per_step": (now - logged) / count} | means)
            sums, since, logged = {}, step, now
        if validation is not None and (step % options.validate_every == 0 or step == training.steps):
            _validate(training, validation, out)
            logged = time.monotonic()
        ending = stopped()
        if ending or step == training.steps or now - saved > 60 * options.save_minutes:
            training.checkpoint().write(last)
            saved = time.monotonic()
        if ending:
            raise Interrupted
    return training


def _prefetched(training: Training) -> Iterator[Crop]:
    """Yield the crops of all steps that are left, each cut while the one before is learnt from."""
    with ThreadPoolExecutor(1) as pool:
        following = pool.submit(training.crop, training.step)
        for step in range(training.step, training.steps):
            crop = following.result()
            if step + 1 < training.steps:
                following = pool.submit(training.crop, step + 1)
            yield crop


def _validate(training: Training, validation: Samples, out: Path) -> None:
    """Reconstruct, log, and keep the weights if they are the best so far."""
    names = list(validation.names)[: training.options.validation_clouds]
    if not names:
        return
    samples = (validation.read(name) for name in names)
    scores = validate(training.averaged_network(), samples, training.options.validation_vertices)
    _log(out, {"step": training.step} | {f"validation_{name}": value for name, value in scores.items()})
    if training.best is None or scores["score"] > training.best:
        training.best = scores["score"]
        training.checkpoint().write(out / BEST)


def _log(out: Path, line: dict[str, float]) -> None:
    with (out / METRICS).open("a") as file:
        file.write(json.dumps(line) + "\n")
