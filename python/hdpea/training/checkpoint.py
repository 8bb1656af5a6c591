# SPDX-License-Identifier: GPL-3.0-or-later
"""Checkpoints: everything needed to resume a training as if it had never stopped, and networks from them."""

from __future__ import annotations

import pickle
import zipfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from hdpea.errors import UnreadableInput, UsageError
from hdpea.geometry.metric import ScaledMetric
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.network.weights import UNRECORDED_METRIC, network_of_state
from hdpea.runtime.outputs import replacing
from hdpea.training.options import CropOptions, LossOptions, TrainingOptions

FORMAT = 1
"""Counts up whenever what is stored changes so that it cannot be read as before."""


@dataclass
class Checkpoint:
    """The state of a training after `step` steps.

    No state of a random generator is stored: crops and the order of curves are functions of the seed and the step.

    Attributes
    ----------
    network, training
        The options.
    metric
        The metric of the samples, in spacings.
    step
        Steps done.
    weights, averaged
        The network's parameters, and their running average, which is validated and used.
    optimizer
        The optimizer's state.
    best
        The best score of a validation so far; None before the first.
    seconds
        Spent so far, if its length is in minutes.
    """

    network: NetworkOptions
    training: TrainingOptions
    metric: ScaledMetric
    step: int
    weights: dict[str, Tensor]
    averaged: dict[str, Tensor]
    optimizer: dict[str, Any]
    best: float | None = None
    seconds: float = 0.0

    def write(self, path: Path) -> None:
        """Write the checkpoint, whole or not at all."""
        content = {each.name: getattr(self, each.name) for each in fields(self)}
        options = {name: asdict(content[name]) for name in ("network", "training", "metric")}
        content |= {"format": FORMAT} | options
        with replacing(path) as partial:
            torch.save(content, partial)

    @classmethod
    def read(cls, path: Path) -> Checkpoint:
        """Read a checkpoint; no code that it might hold is run.

        Raises
        ------
        UnreadableInput
            If it is missing, truncated, no checkpoint of this version, or its options or metric are out of range.
            A checkpoint that records no metric, as older ones, is read with ``UNRECORDED_METRIC``.
        """
        hint = "A checkpoint is a file that `hdpea train` wrote."
        broken = f"{path} is truncated, or no checkpoint."
        try:
            with path.open("rb") as file:
                # torch reads any other file as an old format, and fails in many ways.
                if not zipfile.is_zipfile(file):
                    raise UnreadableInput(broken, hint)
            content = torch.load(path, map_location="cpu", weights_only=True)
        except OSError as error:
            raise UnreadableInput(f"Cannot read {path}: {error.strerror or error}.", hint) from error
        except (RuntimeError, EOFError, ValueError, pickle.UnpicklingError) as error:
            raise UnreadableInput(broken, hint) from error
        if not isinstance(content, Mapping) or "format" not in content:
            raise UnreadableInput(f"{path} is no checkpoint.", hint)
        if content["format"] != FORMAT:
            raise UnreadableInput(
                f"{path} is a checkpoint of format {content['format']}, not {FORMAT}.", "Another version wrote it."
            )
        try:
            rest = {each.name: content[each.name] for each in fields(cls) if each.name not in {"metric", "seconds"}}
            rest |= {
                "network": NetworkOptions.of_record(rest["network"]),
                "training": _training_options(rest["training"]),
                "seconds": float(content.get("seconds", 0.0)),
                "metric": ScaledMetric.of_record(content["metric"]) if "metric" in content else UNRECORDED_METRIC,
            }
            for state in (rest["weights"], rest["averaged"]):
                if not isinstance(state, Mapping) or not all(isinstance(each, Tensor) for each in state.values()):
                    raise ValueError("weights")
        except (KeyError, TypeError, ValueError, UsageError) as error:
            raise UnreadableInput(f"{path} is a checkpoint with parts missing or unknown: {error}.", hint) from error
        return cls(**rest)

    def build(self, averaged: bool = True) -> PointTransformer:
        """Return the network with its averaged weights, or with the last."""
        state = self.averaged if averaged else self.weights
        # Copied, since a training goes on to change its own.
        copied = {name: each.detach().to("cpu", copy=True) for name, each in state.items()}
        try:
            network = network_of_state(self.network, self.metric, copied)
        except ValueError as error:
            raise UnreadableInput(f"The checkpoint's weights {error}.") from error
        return network.eval()


def _training_options(values: Mapping[str, Any]) -> TrainingOptions:
    nested = {"crops": CropOptions(**values["crops"]), "loss": LossOptions(**values["loss"])}
    return TrainingOptions(**{**values, **nested})
