# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights in files: what is written comes back, what is wrong with a file is said."""

from __future__ import annotations

import json
import time
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch
from helpers.networks import TINY, network_of, predicted, unit_torus
from safetensors.torch import load_file, save_file

from hdpea.errors import UnreadableInput
from hdpea.geometry.metric import ScaledMetric
from hdpea.network.weights import SHIPPED, UNRECORDED_METRIC, read_weights, write_weights


@pytest.fixture
def path(tmp_path: Path) -> Path:
    network = network_of(TINY)
    write_weights(tmp_path / "tiny.safetensors", network, {"step": "7"})
    return tmp_path / "tiny.safetensors"


def test_weights_come_back_as_half_precision_leaves_them(path: Path) -> None:
    network, back = network_of(TINY), read_weights(path)
    assert back.options == TINY
    for name, value in network.state_dict().items():
        assert torch.equal(value.half().float(), back.state_dict()[name]), name


def test_the_metric_comes_back(tmp_path: Path) -> None:
    metric = ScaledMetric(scale=20.0, max_stretch=4.0, bending_length=0.5, curvature_radius=1.5)
    write_weights(tmp_path / "other.safetensors", network_of(metric=metric))
    assert read_weights(tmp_path / "other.safetensors").metric == metric


def test_weights_that_record_no_metric_have_the_one_of_before(path: Path) -> None:
    metadata = {"hdpea_format": "1", "network": json.dumps(asdict(TINY))}
    save_file(load_file(path), path, metadata)
    assert read_weights(path).metric == read_weights(SHIPPED).metric == UNRECORDED_METRIC


def test_the_metric_of_the_weights_is_the_one_that_psi_settles_to(tmp_path: Path) -> None:
    points, normals = unit_torus(2000)
    psis = []
    for scale in (0.0001, 40.0):
        write_weights(tmp_path / "scaled", network_of(metric=replace(UNRECORDED_METRIC, scale=scale)))
        psis.append(predicted(read_weights(tmp_path / "scaled"), points, normals))
    # A metric that stretches nothing is solved by a psi that is constant.
    little, much = (np.linalg.norm(psi - psi.mean(axis=0), axis=1).mean() for psi in psis)
    assert little < 0.3 * much


def test_the_shipped_weights_give_the_same_psi_whatever_the_threads() -> None:
    assert SHIPPED.stat().st_size < 20e6
    # An odd number, so that threads cannot share the rows evenly.
    cloud, before = unit_torus(8003), torch.get_num_threads()
    try:
        results = []
        for threads in (1, 2):
            torch.set_num_threads(threads)
            results.append(predicted(read_weights(SHIPPED), *cloud))
    finally:
        torch.set_num_threads(before)
    assert np.array_equal(results[0], results[1])


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        ("missing", "Cannot read"),
        ("truncated", "truncated"),
        ("text", "no safetensors"),
        ("foreign", "format none"),
        ("old", "format 0"),
        ("unknown", "does not describe"),
        ("other", "do not fit"),
    ],
)
def test_a_wrong_file_is_told_apart(damage: str, message: str, path: Path) -> None:
    state = load_file(path)
    metadata = {"hdpea_format": "1", "network": json.dumps({"channels": [16, 32]})}
    if damage == "missing":
        path.unlink()
    elif damage == "truncated":
        path.write_bytes(path.read_bytes()[:-100])
    elif damage == "text":
        path.write_text("no weights")
    elif damage == "foreign":
        save_file(state, path)
    elif damage == "old":
        save_file(state, path, metadata | {"hdpea_format": "0"})
    elif damage == "unknown":
        save_file(state, path, metadata | {"network": '{"layers": 3}'})
    else:
        write_weights(path, network_of(replace(TINY, stem=False)))
        save_file(state, path, metadata | {"network": json.dumps(vars(replace(TINY, stem=False)))})
    with pytest.raises(UnreadableInput, match=message) as error:
        read_weights(path)
    assert "hdpea train" in (error.value.hint or "")


TINY_RECORD = json.loads(json.dumps(asdict(TINY)))


@pytest.mark.parametrize(
    "network",
    [
        *("", "{", "[]", "null", "3", '"text"'),
        pytest.param("[" * 100_000, id="deep"),
        pytest.param("9" * 5_000, id="huge"),
        *(
            TINY_RECORD | {"channels": channels}
            for channels in (
                [],
                [-16, 32],
                [16],
                16,
                None,
                ["16", 32],
                [16.0, 32],
                [16] * 10**5,
                [10**30, 32],
                [True, 32],
            )
        ),
        TINY_RECORD | {"depths": [100_000, 1]},
        TINY_RECORD | {"depths": [-1, 1]},
        TINY_RECORD | {"depths": [[1], 1]},
        TINY_RECORD
        | {"channels": [8] * 11, "depths": [1] * 11, "decoder_channels": [8] * 10, "decoder_depths": [1] * 10},
        TINY_RECORD
        | {"channels": [4096, 4096], "depths": [64, 64], "decoder_channels": [4096], "decoder_depths": [64]},
        TINY_RECORD | {"further": 1},
        *(
            TINY_RECORD | {name: value}
            for name in ("head_width", "patch_size", "voxel", "smoothing", "stem_channels", "seed")
            for value in (-1, 10**30, float("nan"), float("inf"), None, "8", [], {})
        ),
        *(TINY_RECORD | {"shape": value} for value in (None, "no", 0)),
    ],
)
def test_metadata_of_no_network_are_refused_at_once(network: Any, path: Path) -> None:
    text = network if isinstance(network, str) else json.dumps(network)
    save_file(load_file(path), path, {"hdpea_format": "1", "network": text})
    began = time.monotonic()
    with pytest.raises(UnreadableInput, match=r"does not describe|do not fit"):
        read_weights(path)
    assert time.monotonic() - began < 2


@pytest.mark.parametrize(
    "metric", ["", "null", "[]", "{}", '{"scale": NaN}', json.dumps({"scale": 40, "max_stretch": -6})]
)
def test_metadata_of_no_metric_are_refused(metric: str, path: Path) -> None:
    save_file(load_file(path), path, {"hdpea_format": "1", "network": json.dumps(asdict(TINY)), "metric": metric})
    with pytest.raises(UnreadableInput, match="does not describe"):
        read_weights(path)


@pytest.mark.parametrize(
    "header",
    [b"\xff\xfe", b"{", b'{"__metadata__": null}', b'{"__metadata__": []}', pytest.param(b"[" * 10_000, id="deep")],
)
def test_headers_of_no_weights_are_refused(header: bytes, path: Path) -> None:
    path.write_bytes(len(header).to_bytes(8, "little") + header)
    with pytest.raises(UnreadableInput):
        read_weights(path)


def test_weights_that_are_no_numbers_are_refused(path: Path) -> None:
    state = {name: torch.full_like(value, float("nan")) for name, value in load_file(path).items()}
    save_file(state, path, {"hdpea_format": "1", "network": json.dumps(asdict(TINY))})
    with pytest.raises(UnreadableInput, match="finite"):
        read_weights(path)
