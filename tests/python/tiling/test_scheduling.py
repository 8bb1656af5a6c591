# SPDX-License-Identifier: GPL-3.0-or-later
"""Tasks are tried again whose worker died, and no others."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from hdpea.errors import HdpeaError
from hdpea.options import Options
from hdpea.runtime.processes import Outcome
from hdpea.tiling import scheduling
from hdpea.tiling.folder import WorkFolder
from hdpea.tiling.tasks import Task, Took
from hdpea.tiling.work import Work

TASK = Task(Work(WorkFolder(Path()), None, Options()), "normals", 0)  # type: ignore[arg-type]

TOOK = Took(1.0, 1)


def tried(monkeypatch: pytest.MonkeyPatch, *outcomes: Outcome[Took]) -> list[tuple[int, Took]]:
    """Return what two processes make of a task whose first tries have these outcomes, one after the other."""
    waiting = iter(outcomes)

    def next_outcome(*_: object, **__: object) -> Iterator[Outcome[Took]]:
        yield next(waiting)

    monkeypatch.setattr(scheduling, "run_isolated", next_outcome)
    return list(scheduling.run([TASK], [()], 2))


def test_a_task_whose_worker_died_is_tried_again_whatever_is_said_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    died = Outcome[Took](0, 1.0, failed="Gone.", died=True)
    assert tried(monkeypatch, died, died, Outcome(0, 1.0, TOOK)) == [(0, TOOK)]
    with pytest.raises(HdpeaError, match=r"normals of tile 0 failed: Gone\."):
        tried(monkeypatch, *[died] * scheduling.ATTEMPTS)


def test_a_task_that_failed_is_not_tried_again(monkeypatch: pytest.MonkeyPatch) -> None:
    failed = Outcome[Took](0, 1.0, failed="Its process ended with a sigh.")
    with pytest.raises(HdpeaError, match="a sigh"):
        tried(monkeypatch, failed, Outcome(0, 1.0, TOOK))
