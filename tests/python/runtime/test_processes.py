# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import math
import multiprocessing
import os
import subprocess
import time
from contextlib import suppress
from pathlib import Path

import pytest

from hdpea.runtime.processes import run_isolated


@pytest.mark.parametrize("jobs", [1, 2, 8])
def test_every_task_has_its_outcome(jobs: int) -> None:
    outcomes = sorted(run_isolated(math.factorial, [3, 4, -1, 5], jobs, 60), key=lambda each: each.index)
    assert [each.result for each in outcomes] == [6, 24, None, 120]
    assert [each.failed for each in outcomes] == ["", "", "ValueError: factorial() not defined for negative values", ""]
    assert not any(each.died for each in outcomes)
    assert list(run_isolated(math.factorial, [], jobs, 60)) == []


def test_a_task_waits_for_others_and_is_left_out_if_one_of_them_fails() -> None:
    after: list[set[int]] = [{1}, set(), {3}, set()]
    outcomes = list(run_isolated(math.factorial, [3, 4, 5, -1], 2, 60, after=after))
    order = [each.index for each in outcomes]
    assert sorted(order) == [0, 1, 3]
    assert order.index(1) < order.index(0)


def test_a_process_that_ends_costs_its_task_only() -> None:
    outcomes = list(run_isolated(os._exit, [3, 4], 1, 60))
    assert [each.failed for each in outcomes] == [
        "Its process ended with exit code 3.",
        "Its process ended with exit code 4.",
    ]
    assert all(each.died for each in outcomes)


def test_a_task_that_takes_too_long_is_given_up() -> None:
    outcomes = {each.index: each.failed for each in run_isolated(time.sleep, [60, 0], 2, 3)}
    assert outcomes == {0: "It took longer than 3 s.", 1: ""}


def test_fresh_processes_do_one_task_each() -> None:
    groups = [each.result for each in run_isolated(os.getpgid, [0, 0, 0], 1, fresh=True)]
    assert len(set(groups)) == 3


def test_who_stops_asking_ends_the_processes() -> None:
    outcomes = run_isolated(time.sleep, [0, 60, 60], 2, 60)
    next(outcomes)
    outcomes.close()
    assert multiprocessing.active_children() == []


def test_programs_end_with_the_process_that_runs_them() -> None:
    unusual = "3607.25"
    (outcome,) = run_isolated(subprocess.check_call, [["sleep", unusual]], 1, 3)
    assert outcome.failed == "It took longer than 3 s."
    for _ in range(100):
        if not running(unusual):
            return
        time.sleep(0.05)
    raise AssertionError("The program runs on.")


def running(argument: str) -> bool:
    commands = []
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with suppress(OSError):  # it has just ended
            commands.append(path.read_bytes())
    return any(argument.encode() in command.split(b"\0") for command in commands)
