# SPDX-License-Identifier: GPL-3.0-or-later
"""What a training leaves on the disk, and reads again."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
import torch
from helpers.networks import METRIC, QUICK, TINY, InMemory, torus_sample

from hdpea.errors import UnreadableInput, UsageError
from hdpea.network.weights import UNRECORDED_METRIC, read_weights
from hdpea.training.checkpoint import FORMAT, Checkpoint
from hdpea.training.joined import Joined
from hdpea.training.loop import train


def test_whoever_reads_the_folder_meanwhile_finds_whole_files(tmp_path: Path) -> None:
    seen: list[int] = []

    def look() -> bool:
        if (tmp_path / "last.pt").exists():
            seen.append(Checkpoint.read(tmp_path / "last.pt").step)
            assert read_weights(tmp_path / "last.safetensors").options == TINY
        return False

    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=4, save_minutes=0), look)
    assert seen == [1, 2, 3]


def test_other_options_are_refused_but_for_the_steps(tmp_path: Path) -> None:
    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=2))
    assert train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=3)).step == 3
    with pytest.raises(UsageError, match="other options"):
        train(InMemory(), None, tmp_path, TINY, replace(QUICK, batch=4))
    with pytest.raises(UsageError, match="other options"):
        train(InMemory(), None, tmp_path, replace(TINY, smoothing=5), QUICK)


OTHER_METRIC = replace(METRIC, scale=20.0)


def test_the_metric_is_that_of_the_samples_and_comes_along_with_the_weights(tmp_path: Path) -> None:
    validation = InMemory({"torus": torus_sample(2000)}, metric=OTHER_METRIC)
    options = replace(QUICK, steps=1, validation_vertices=200)
    train(InMemory(metric=OTHER_METRIC), validation, tmp_path, TINY, options)
    assert Checkpoint.read(tmp_path / "last.pt").build().metric == OTHER_METRIC
    assert read_weights(tmp_path / "best.safetensors").metric == OTHER_METRIC


def test_another_metric_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="metric of the validation set"):
        train(InMemory(), InMemory(metric=OTHER_METRIC), tmp_path, TINY, QUICK)
    with pytest.raises(UsageError, match="metric of another dataset"):
        Joined([InMemory(), InMemory(metric=OTHER_METRIC)])
    with pytest.raises(UsageError, match="scale of 0"):
        train(InMemory(metric=replace(METRIC, scale=0.0)), None, tmp_path, TINY, QUICK)
    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=1))
    with pytest.raises(UsageError, match="samples of another metric"):
        train(InMemory(metric=OTHER_METRIC), None, tmp_path, TINY, QUICK)


def test_a_checkpoint_that_records_no_metric_still_loads(tmp_path: Path) -> None:
    train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=1))
    content = torch.load(tmp_path / "last.pt", weights_only=True)
    del content["metric"]
    torch.save(content, tmp_path / "last.pt")
    assert Checkpoint.read(tmp_path / "last.pt").build().metric == UNRECORDED_METRIC
    assert train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=2)).step == 2


@pytest.mark.parametrize(
    "damage", ["missing", "truncated", "text", "other", "format", "parts", "weights", "tensors", "network", "metric"]
)
def test_a_damaged_checkpoint_is_told_apart(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "last.pt"
    if damage != "missing":
        train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=1))
        content = torch.load(path, weights_only=True)
    if damage == "truncated":
        path.write_bytes(path.read_bytes()[:2000])
    elif damage == "text":
        path.write_text("no checkpoint")
    elif damage == "other":
        torch.save([1, 2], path)
    elif damage == "format":
        torch.save(content | {"format": FORMAT + 1}, path)
    elif damage == "parts":
        del content["optimizer"]
        torch.save(content, path)
    elif damage == "weights":
        torch.save(content | {"averaged": {"other": torch.zeros(1)}}, path)
    elif damage == "tensors":
        torch.save(content | {"averaged": [1, 2]}, path)
    elif damage == "network":
        torch.save(content | {"network": content["network"] | {"depths": (100_000, 1)}}, path)
    elif damage == "metric":
        torch.save(content | {"metric": content["metric"] | {"scale": float("nan")}}, path)
    with pytest.raises(UnreadableInput):
        Checkpoint.read(path).build()
