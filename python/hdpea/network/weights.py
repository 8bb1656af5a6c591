# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights in a file of their own: what a trained network is passed on as."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save_file

from hdpea.errors import UnreadableInput
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.runtime.outputs import replacing

SHIPPED = Path(__file__).with_name("compact.safetensors")
"""The weights that come along: docs/training.md says what they were trained on, and how."""

FORMAT = "1"
"""Counts up whenever the meaning of the weights changes: layers, inputs, outputs."""

_HINT = "Weights are a safetensors file that `hdpea train` of this version wrote."


def write_weights(path: Path, network: PointTransformer, facts: Mapping[str, str] | None = None) -> None:
    """Write a network in half precision, with its options and `facts` about it as metadata; whole or not at all."""
    metadata = dict(facts or {}) | {"hdpea_format": FORMAT, "network": json.dumps(asdict(network.options))}
    halves = {
        name: value.detach().to("cpu", torch.float16).contiguous() for name, value in network.state_dict().items()
    }
    with replacing(path) as partial:
        save_file(halves, partial, metadata)


def read_weights(path: Path) -> PointTransformer:
    """Return the network of a file of weights, ready to be used.

    Raises
    ------
    UnreadableInput
        If the file is missing, truncated, no safetensors file, of another format, or its weights do not fit the
        network that it names.
    """
    try:
        with safe_open(path, framework="pt") as file:
            metadata = file.metadata() or {}
            state = {name: file.get_tensor(name).float() for name in file.keys()}  # noqa: SIM118
    except OSError as error:
        raise UnreadableInput(f"Cannot read the weights {path}: {error.strerror or error}.", _HINT) from error
    except SafetensorError as error:
        raise UnreadableInput(f"{path} is no safetensors file, or it is truncated.", _HINT) from error
    if metadata.get("hdpea_format") != FORMAT:
        given = metadata.get("hdpea_format", "none")
        raise UnreadableInput(f"{path} holds weights of format {given}; this hdpea reads format {FORMAT}.", _HINT)
    network = PointTransformer(_options(path, metadata))
    try:
        network.load_state_dict(state)
    except RuntimeError as error:
        raise UnreadableInput(f"The weights in {path} do not fit the network that it names.", _HINT) from error
    return network.eval()


def _options(path: Path, metadata: Mapping[str, str]) -> NetworkOptions:
    try:
        values: dict[str, Any] = json.loads(metadata["network"])
        # JSON has lists for tuples.
        values |= {name: tuple(each) for name, each in values.items() if isinstance(each, list)}
        return NetworkOptions(**values)
    except (KeyError, TypeError, ValueError) as error:
        raise UnreadableInput(f"{path} does not say what network its weights are of: {error}.", _HINT) from error
