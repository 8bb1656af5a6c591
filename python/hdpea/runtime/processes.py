# SPDX-License-Identifier: GPL-3.0-or-later
"""Work in processes of its own, so that whatever goes wrong with one task does not touch the others."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Collection, Generator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from math import inf
from multiprocessing import get_context, parent_process
from multiprocessing.connection import Connection, wait
from typing import Generic, TypeVar

from hdpea.errors import HdpeaError

Task = TypeVar("Task")
Result = TypeVar("Result")


@dataclass(frozen=True)
class Outcome(Generic[Result]):
    """What became of task number `index`: its result, or else why it `failed`, in a sentence.

    ``died`` tells whether the process ended without an answer, so that another one may succeed.
    """

    index: int
    seconds: float
    result: Result | None = None
    failed: str = ""
    died: bool = False


def run_isolated(
    function: Callable[[Task], Result],
    tasks: Sequence[Task],
    jobs: int,
    time_limit: float = inf,
    fresh: bool = False,
    after: Sequence[Collection[int]] = (),
) -> Generator[Outcome[Result], None, None]:
    """Apply `function` to every task, `jobs` at a time; yield the outcomes as they come, in any order.

    An exception, a crash of the process, or more than `time_limit` seconds make a task fail, and only that one.
    When the iterator is closed, or this process ends in whatever way, so do the others.

    Parameters
    ----------
    function
        Of a module, since the processes import it; tasks and results must be picklable.
    fresh
        Whether each task has a process of its own, so that no memory of one is held during the next.
    after
        For each task, the numbers of those that must have succeeded before it begins, if any; where one of them fails,
        the task is left out.
    """
    waiting = _Waiting(tasks, after)
    workers = [_Worker(function, fresh) for _ in range(min(jobs, len(tasks)))]
    try:
        while busy := [worker for worker in workers if not worker.idle or worker.take(waiting)]:
            soonest = min(worker.started for worker in busy) + time_limit - time.monotonic()
            ready = wait([worker.connection for worker in busy], None if soonest == inf else max(soonest, 0))
            for worker in busy:
                if worker.connection in ready:
                    outcome = worker.outcome()
                    if not outcome.failed:
                        waiting.succeeded.add(outcome.index)
                    yield outcome
                elif worker.seconds() > time_limit:
                    worker.end()
                    yield Outcome(worker.index, worker.seconds(), failed=f"It took longer than {time_limit:g} s.")
                else:
                    continue
                worker.idle = True
    finally:
        for worker in workers:
            worker.end()


class _Waiting(Generic[Task]):
    """The tasks that have not begun, first to last, and the numbers of those that have succeeded."""

    def __init__(self, tasks: Sequence[Task], after: Sequence[Collection[int]]) -> None:
        self._tasks, self._after = dict(enumerate(tasks)), after
        self.succeeded: set[int] = set()

    def next(self) -> tuple[int, Task] | None:
        """Take out the first task that may begin; None if there is none."""
        for index in self._tasks:
            if not self._after or self.succeeded.issuperset(self._after[index]):
                return index, self._tasks.pop(index)
        return None


class _Worker(Generic[Task, Result]):
    """A process that does one task after another, and is replaced by another when it breaks."""

    def __init__(self, function: Callable[[Task], Result], fresh: bool) -> None:
        self._function, self._fresh, self._used = function, fresh, False
        self.index, self.started, self.idle = 0, 0.0, True
        self._start()

    def _start(self) -> None:
        # Forking a process with threads, as those of the core, may hang.
        context = get_context("spawn")
        self.connection, theirs = context.Pipe()
        self._process = context.Process(target=_serve, args=(theirs, self._function), daemon=True)
        self._process.start()
        theirs.close()

    def take(self, waiting: _Waiting[Task]) -> bool:
        """Begin the next task; False if none may begin."""
        following = waiting.next()
        if following is None:
            return False
        if self._fresh and self._used:
            self.end()
        if not self._process.is_alive():
            self._start()
        self._used = True
        self.index, task = following
        self.started, self.idle = time.monotonic(), False
        self.connection.send(task)
        return True

    def seconds(self) -> float:
        """Return how long the task has taken so far."""
        return time.monotonic() - self.started

    def outcome(self) -> Outcome[Result]:
        """Return what the process has sent, or how it ended without."""
        try:
            result, failed = self.connection.recv()
        except (EOFError, ConnectionResetError):
            self.end()
            failed = f"Its process ended with {_ending(self._process.exitcode)}."
            return Outcome(self.index, self.seconds(), failed=failed, died=True)
        return Outcome(self.index, self.seconds(), result, failed)

    def end(self) -> None:
        """End the process, whatever it is doing, and the programs it runs."""
        if self._process.pid is not None:
            # Without a group of its own yet, it has run no program yet either.
            with suppress(ProcessLookupError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.kill()
        self._process.join()
        self.connection.close()


def _ending(exit_code: int | None) -> str:
    return f"signal {signal.Signals(-exit_code).name}" if exit_code and exit_code < 0 else f"exit code {exit_code}"


def _serve(connection: Connection, function: Callable[[Task], Result]) -> None:
    # Ctrl-C is for the process that started this one; when that has ended, nobody waits for results.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.setpgrp()  # programs that it runs are to end with it
    threading.Thread(target=_end_with_parent, daemon=True).start()
    while True:
        try:
            task = connection.recv()
        except EOFError:
            return
        connection.send(_attempt(function, task))


def _attempt(function: Callable[[Task], Result], task: Task) -> tuple[Result | None, str]:
    try:
        return function(task), ""
    except HdpeaError as error:
        return None, error.message
    except Exception as error:  # noqa: BLE001 whatever it is, the other tasks go on
        return None, f"{type(error).__name__}: {error}"


def _end_with_parent() -> None:
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os.killpg(0, signal.SIGKILL)
