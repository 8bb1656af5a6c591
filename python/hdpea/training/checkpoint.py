# SPDX-License-Identifier: GPL-3.0-or-later
"""Checkpoints: everything that training needs to go on as if it had never stopped, and networks from them."""

from __future__ import annotations

import pickle
import zipfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import torch
from torch import Tensor

from hdpea.errors import UnreadableInput
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.runtime.outputs import replacing
from hdpea.training.options import CropOptions, LossOptions, TrainingOptions

FORMAT = 1
"""Counts up whenever what is kept changes."""


@dataclass
class Checkpoint:
    """The state of a training after `step` steps.

    Nothing random is kept because nothing random runs on: crops and the order of curves are functions of the
    seed and the step.

    Attributes
    ----------
    network, training
        The options.
    step
        Steps done.
    weights, averaged
        The network's parameters, and their running average, which is what is judged and used.
    optimizer
        The optimizer's state.
    best
        The best score of a validation so far; None before the first.
    """

    network: NetworkOptions
    training: TrainingOptions
    step: int
    weights: dict[str, Tensor]
    averaged: dict[str, Tensor]
    optimizer: dict[str, Any]
    best: float | None = None

    def write(self, path: Path) -> None:
        """Write the checkpoint, whole or not at all."""
        content = {each.name: getattr(self, each.name) for each in fields(self)}
        content |= {"format": FORMAT, "network": asdict(self.network), "training": asdict(self.training)}
        with replacing(path) as partial:
            torch.save(content, partial)

    @classmethod
    def read(cls, path: Path) -> Checkpoint:
        """Read a checkpoint; no code that it might hold is run.

        Raises
        ------
        UnreadableInput
            If it is missing, truncated, or no checkpoint of this version.
        """
        hint = "A checkpoint is a file that `hdpea train` wrote."
        broken = f"{path} is truncated, or no checkpoint."
        try:
            with path.open("rb") as file:
                # What torch does with other files is to read them as an old format, and to fail in many ways.
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
            rest = {each.name: content[each.name] for each in fields(cls)}
            rest |= {"network": _network_options(rest["network"]), "training": _training_options(rest["training"])}
        except (KeyError, TypeError) as error:
            raise UnreadableInput(f"{path} is a checkpoint with parts missing or unknown: {error}.", hint) from error
        return cls(**rest)

    def build(self, averaged: bool = True) -> PointTransformer:
        """Return the network with its averaged weights, or with the last."""
        network = PointTransformer(self.network)
        try:
            network.load_state_dict(self.averaged if averaged else self.weights)
        except RuntimeError as error:
            raise UnreadableInput("The checkpoint's weights do not fit its network.") from error
        return network.eval()


def _network_options(values: Mapping[str, Any]) -> NetworkOptions:
    return NetworkOptions(**values)


def _training_options(values: Mapping[str, Any]) -> TrainingOptions:
    nested = {"crops": CropOptions(**values["crops"]), "loss": LossOptions(**values["loss"])}
    return TrainingOptions(**{**values, **nested})
