# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights in files: what is written comes back, what is wrong with a file is said."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
import torch
from helpers.networks import TINY, predicted, unit_torus
from safetensors.torch import load_file, save_file

from hdpea.errors import UnreadableInput
from hdpea.network.transformer import PointTransformer
from hdpea.network.weights import SHIPPED, read_weights, write_weights


@pytest.fixture
def path(tmp_path: Path) -> Path:
    network = PointTransformer(TINY)
    write_weights(tmp_path / "tiny.safetensors", network, {"step": "7"})
    return tmp_path / "tiny.safetensors"


def test_weights_come_back_as_half_precision_leaves_them(path: Path) -> None:
    network, back = PointTransformer(TINY), read_weights(path)
    assert back.options == TINY
    for name, value in network.state_dict().items():
        assert torch.equal(value.half().float(), back.state_dict()[name]), name


def test_the_weights_that_come_along_give_the_same_psi_whatever_the_threads() -> None:
    assert SHIPPED.stat().st_size < 20e6
    cloud, before = unit_torus(8000), torch.get_num_threads()
    try:
        results = []
        for threads in (1, 2):
            torch.set_num_threads(threads)
            results.append(predicted(read_weights(SHIPPED), *cloud))
    finally:
        torch.set_num_threads(before)
    assert abs(results[0] - results[1]).max() <= 1e-5


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        ("missing", "Cannot read"),
        ("truncated", "truncated"),
        ("text", "no safetensors"),
        ("foreign", "format none"),
        ("old", "format 0"),
        ("unknown", "does not say"),
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
        write_weights(path, PointTransformer(replace(TINY, stem=False)))
        save_file(state, path, metadata | {"network": json.dumps(vars(replace(TINY, stem=False)))})
    with pytest.raises(UnreadableInput, match=message) as error:
        read_weights(path)
    assert "hdpea train" in (error.value.hint or "")
