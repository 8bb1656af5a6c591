# SPDX-License-Identifier: GPL-3.0-or-later
"""Training: the same wherever it is stopped, and in as many processes as you like."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
import torch
from helpers.networks import (
    QUICK,
    TINY,
    InMemory,
    network_of,
    same,
)

from hdpea.errors import Interrupted, UsageError
from hdpea.training.checkpoint import Checkpoint
from hdpea.training.loop import train
from hdpea.training.options import PRESETS, LossOptions, TrainingOptions
from hdpea.training.steps import Training, learning_share
from hdpea.training.stopping import stop_requests


def stop_after(steps: int) -> object:
    calls = iter(range(1, 1000))
    return lambda: next(calls) >= steps


def test_a_training_that_was_stopped_ends_as_one_that_was_not(tmp_path: Path) -> None:
    straight, stopped = tmp_path / "straight", tmp_path / "stopped"
    straight.mkdir()
    stopped.mkdir()
    train(InMemory(), None, straight, TINY, QUICK)
    with pytest.raises(Interrupted):
        train(InMemory(), None, stopped, TINY, QUICK, stop_after(5))
    assert Checkpoint.read(stopped / "last.pt").step == 5
    train(InMemory(), None, stopped, TINY, QUICK)
    first, second = (Checkpoint.read(folder / "last.pt") for folder in (straight, stopped))
    assert same(vars(first), vars(second))


class Clock:
    """Tells a second more each time."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        self.seconds += 1
        return self.seconds


def test_a_training_of_minutes_ends_by_the_clock_with_the_rate_down_and_resumes(tmp_path: Path) -> None:
    straight, stopped = tmp_path / "straight", tmp_path / "stopped"
    straight.mkdir()
    stopped.mkdir()
    options = replace(QUICK, minutes=0.2, save_minutes=0.1)
    ended = train(InMemory(), None, straight, TINY, options, clock=Clock())
    assert (ended.step, ended.seconds, ended.done) == (12, 12, 1)
    assert max(group["lr"] for group in ended.optimizer.param_groups) < 0.1 * options.learning_rate
    with pytest.raises(Interrupted):
        train(InMemory(), None, stopped, TINY, options, stop_after(5), clock=Clock())
    train(InMemory(), None, stopped, TINY, options, clock=Clock())
    first, second = (Checkpoint.read(folder / "last.pt") for folder in (straight, stopped))
    assert same(vars(first), vars(second))


def test_a_training_starts_from_given_weights(tmp_path: Path) -> None:
    trained = train(InMemory(), None, tmp_path, TINY, replace(QUICK, steps=3)).averaged_network()
    training = Training(InMemory(), TINY, QUICK)
    training.start_from(trained)
    assert same(dict(training.averaged_network().state_dict()), dict(trained.state_dict()))
    with pytest.raises(UsageError, match="another network"):
        training.start_from(network_of(replace(TINY, smoothing=5)))


def test_the_loss_falls(tmp_path: Path) -> None:
    from_nothing = replace(TINY, normal_share=0.0)
    train(InMemory(), None, tmp_path, from_nothing, replace(QUICK, steps=60, log_every=10, learning_rate=0.01))
    lines = [json.loads(line) for line in (tmp_path / "metrics.jsonl").read_text().splitlines()]
    assert [line["step"] for line in lines] == [10, 20, 30, 40, 50, 60]
    assert lines[-1]["loss"] < 0.8 * lines[0]["loss"]


@pytest.mark.parametrize("loss", ["ndhde-mae", "ndhde-mse", "point-mse", "point-mae"])
def test_every_loss_trains(loss: str, tmp_path: Path) -> None:
    options = replace(QUICK, steps=2, loss=LossOptions(loss=loss))
    assert train(InMemory(), None, tmp_path, TINY, options).step == 2


def test_half_precision_trains_as_full_does() -> None:
    # What a GPU runs, on a CPU.
    parts = {}
    for half in (False, True):
        training = Training(InMemory(), TINY, QUICK)
        training.half = half
        parts[half] = training.run_step(training.crops[0])
        assert all(value.dtype == torch.float32 for value in training.network.state_dict().values())
    assert parts[True] != parts[False]
    assert parts[True] == pytest.approx(parts[False], rel=0.03)


def test_the_learning_rate_rises_and_falls() -> None:
    shares = [learning_share(step, 10, max(step - 10, 0) / 90) for step in range(100)]
    assert shares[0] == pytest.approx(0.1)
    assert max(shares) == shares[10] == 1
    assert shares[-1] < 0.01


def test_the_paper_s_preset_is_the_paper_s() -> None:
    paper = PRESETS["paper"]
    assert (paper.learning_rate, paper.attention_rate, paper.batch, paper.epochs) == (0.01, 1e-4, 16, 5000)
    training = Training(InMemory(), TINY, replace(paper, batch=2))
    assert training.steps == 5000 * 2
    assert [group["full_rate"] for group in training.optimizer.param_groups] == [0.01, 1e-4]
    assert PRESETS["cpu"] == TrainingOptions()


def test_an_empty_dataset_is_refused() -> None:
    with pytest.raises(UsageError, match="no samples"):
        Training(InMemory({}), TINY, QUICK)


def test_ctrl_c_is_a_request() -> None:
    before = signal.getsignal(signal.SIGINT)
    with stop_requests() as stopped:
        assert not stopped()
        os.kill(os.getpid(), signal.SIGINT)
        assert stopped()
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.slow
def test_two_processes_learn_what_one_does(tmp_path: Path) -> None:
    start = network_of(TINY).state_dict()
    alone = train(InMemory(), None, tmp_path, TINY, QUICK).network.state_dict()
    together = tmp_path / "together"
    together.mkdir()
    torchrun = [sys.executable, "-m", "torch.distributed.run", "--standalone", "--nproc-per-node", "2"]
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    subprocess.run([*torchrun, "-m", "helpers.training_together", together], env=environment, check=True, timeout=300)
    weights = Checkpoint.read(together / "last.pt").weights
    apart = torch.cat([(weights[name] - value).flatten() for name, value in alone.items()])
    moved = torch.cat([(start[name] - value).flatten() for name, value in alone.items()])
    # Adam moves a weight as far for a gradient of 1e-12 as for one of 1, so a few follow rounding.
    assert apart.norm() < 0.02 * moved.norm()
