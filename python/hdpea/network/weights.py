# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights in a file of their own: what a trained network is passed on as."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save_file

from hdpea.errors import UnreadableInput, UsageError
from hdpea.geometry.metric import ScaledMetric
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.runtime.outputs import replacing

SHIPPED = Path(__file__).with_name("compact.safetensors")
"""The weights that are shipped with hdpea: docs/training.md says what they were trained on, and how."""

UNRECORDED_METRIC = ScaledMetric(scale=40.0, max_stretch=6.0, bending_length=0.6, curvature_radius=1.0)
"""The metric, in spacings, of weights and checkpoints that record none, since they are older than the record."""

FORMAT = "1"
"""Counts up whenever the meaning of the weights changes: layers, inputs, outputs."""

_HINT = "Weights are a safetensors file that `hdpea train` of this version wrote."


def write_weights(path: Path, network: PointTransformer, facts: Mapping[str, str] | None = None) -> None:
    """Write a network in half precision, whole or not at all.

    Its options, its metric and `facts` about it are the metadata of the file.
    """
    metadata = dict(facts or {}) | {
        "hdpea_format": FORMAT,
        "network": json.dumps(asdict(network.options)),
        "metric": json.dumps(asdict(network.metric)),
    }
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
        If the file is missing, truncated, no safetensors file, of another format, its metadata describe no network or
        no metric, or its weights are not finite or do not fit the network.
    """
    try:
        with safe_open(path, framework="pt") as file:
            metadata = file.metadata() or {}
            state = {name: file.get_tensor(name).float() for name in file.keys()}  # noqa: SIM118
    except OSError as error:
        raise UnreadableInput(f"Cannot read the weights {path}: {error.strerror or error}.", _HINT) from error
    except (SafetensorError, UnicodeError) as error:
        raise UnreadableInput(f"{path} is no safetensors file, or it is truncated.", _HINT) from error
    if metadata.get("hdpea_format") != FORMAT:
        given = metadata.get("hdpea_format", "none")[:20]
        raise UnreadableInput(f"{path} holds weights of format {given}; this hdpea reads format {FORMAT}.", _HINT)
    options, metric = _described(path, metadata)
    try:
        network = network_of_state(options, metric, state)
    except ValueError as error:
        raise UnreadableInput(f"The weights in {path} {error}.", _HINT) from error
    if not all(torch.isfinite(value).all() for value in state.values()):
        raise UnreadableInput(f"The weights in {path} are not all finite.", _HINT)
    return network.eval()


def network_of_state(
    options: NetworkOptions, metric: ScaledMetric, state: Mapping[str, torch.Tensor]
) -> PointTransformer:
    """Return the network of these options with the parameters `state`, by name; they are not copied.

    Raises
    ------
    ValueError
        If the parameters do not fit the network.
    """
    # Without memory or values of its own: what the options ask for is compared with what there is before it is made.
    with torch.device("meta"):
        network = PointTransformer(options, metric)
    try:
        network.load_state_dict(state, assign=True)
    except (RuntimeError, TypeError) as error:
        raise ValueError("do not fit the network that is described") from error
    return network


def _described(path: Path, metadata: Mapping[str, str]) -> tuple[NetworkOptions, ScaledMetric]:
    try:
        options = NetworkOptions.of_record(json.loads(metadata["network"]))
        recorded = metadata.get("metric")
        return options, UNRECORDED_METRIC if recorded is None else ScaledMetric.of_record(json.loads(recorded))
    except KeyError as error:
        raise UnreadableInput(f"{path} does not describe the network of its weights.", _HINT) from error
    except (ValueError, UsageError, RecursionError) as error:
        what = f"{path} does not describe the network of its weights: {str(error).rstrip('.')}."
        raise UnreadableInput(what, _HINT) from error
