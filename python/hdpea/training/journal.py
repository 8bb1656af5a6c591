# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a training: metrics, the state to resume from, the best weights so far."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from hdpea.network.weights import write_weights
from hdpea.training.crops import Samples
from hdpea.training.steps import Training
from hdpea.training.validation import validate

LAST, LAST_WEIGHTS, METRICS = "last.pt", "last.safetensors", "metrics.jsonl"
"""File names: checkpoint to resume from, its averaged weights, metrics."""

BEST, WEIGHTS = "best.pt", "best.safetensors"
"""File names: checkpoint of the best validation, its averaged weights."""


class Journal:
    """Writes metrics, checkpoints and weights of a training to a folder, in the first of its processes only."""

    def __init__(self, training: Training, out: Path, board: bool, tell: Callable[[str], None]) -> None:
        self.training, self.out, self.tell = training, out, tell
        self.writes = training.workers.rank == 0
        self._board = _tensorboard(out) if board and self.writes else None
        self._begin()

    def _begin(self) -> None:
        self._sums: dict[str, float] = {}
        self._count, self._since = 0, time.monotonic()

    def add(self, parts: Mapping[str, float]) -> None:
        """Add the terms of the loss of one step."""
        self._count += 1
        for name, value in parts.items():
            self._sums[name] = self._sums.get(name, 0.0) + value

    def write_means(self) -> None:
        """Write the means over the steps since the last call."""
        means = {name: value / self._count for name, value in self._sums.items()}
        means["seconds_per_step"] = (time.monotonic() - self._since) / self._count
        self._write(self.training.workers.mean(means))
        self._begin()

    def validate(self, validation: Samples) -> None:
        """Reconstruct clouds with the averaged weights, write the scores, keep the weights if they are the best."""
        training, started = self.training, time.monotonic()
        # Evenly over the names, since similar names are often similar shapes.
        count = min(training.options.validation_clouds, len(validation.names))
        names = [validation.names[place * len(validation.names) // count] for place in range(count)]
        if self.writes and names:
            samples = ((validation.read(name), validation.spacing(name)) for name in names)
            scores = validate(training.averaged_network(), samples, training.options.validation_vertices)
            self._write({f"validation_{name}": value for name, value in scores.items()})
            if training.best is None or scores["score"] > training.best:
                training.best = scores["score"]
                facts = {name: f"{value:.4g}" for name, value in scores.items()}
                self.save(BEST, WEIGHTS, facts)
        self._since += time.monotonic() - started

    def save(self, name: str = LAST, weights: str = LAST_WEIGHTS, facts: Mapping[str, str] | None = None) -> None:
        """Write a checkpoint and its averaged weights; whoever reads them meanwhile finds those before, whole."""
        if self.writes:
            self.training.checkpoint().write(self.out / name)
            known = {"step": str(self.training.step)} | dict(facts or {})
            write_weights(self.out / weights, self.training.averaged_network(), known)

    def _length(self) -> str:
        training, minutes = self.training, self.training.options.minutes
        return f" of {training.steps}" if minutes is None else f", {training.seconds / 60:.1f} of {minutes:g} minutes"

    def _write(self, numbers: Mapping[str, float]) -> None:
        if not self.writes:
            return
        with (self.out / METRICS).open("a") as file:
            file.write(json.dumps({"step": self.training.step} | dict(numbers)) + "\n")
        listed = "  ".join(f"{name} {value:.4g}" for name, value in numbers.items())
        self.tell(f"step {self.training.step}{self._length()}: {listed}")
        if self._board is not None:
            for name, value in numbers.items():
                self._board.add_scalar(name, value, self.training.step)
            self._board.flush()


def _tensorboard(out: Path) -> Any:
    """Return a writer for TensorBoard; None where it is not installed."""
    if find_spec("tensorboard") is None:
        return None
    return import_module("torch.utils.tensorboard").SummaryWriter(out)
