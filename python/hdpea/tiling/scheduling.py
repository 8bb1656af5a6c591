# SPDX-License-Identifier: GPL-3.0-or-later
"""Who does the tasks: this process, several of them, or the workers of a Dask cluster. The results are the same."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from contextlib import closing
from typing import Any

from hdpea.errors import HdpeaError, UsageError
from hdpea.runtime.processes import run_isolated
from hdpea.tiling.tasks import Task, Took, perform

ATTEMPTS = 3
"""How often a task is tried whose worker dies."""


def run(
    tasks: Sequence[Task], after: Sequence[Collection[int]], jobs: int = 1, scheduler: str | None = None
) -> Iterator[tuple[int, Took]]:
    """Do all tasks, none before those that it must wait for; yield each with what it took as it is done.

    Parameters
    ----------
    after
        For each task, the numbers of those that it must wait for.
    jobs
        Processes to use; 1: this one.
    scheduler
        Address of a Dask scheduler, such as ``tcp://host:8786``, whose workers see the same work folder.

    Raises
    ------
    HdpeaError
        Of the kind of its own if a task fails, or if its workers die again and again.
    UsageError
        If Dask is not installed, or there is no scheduler.
    """
    if scheduler is not None:
        return _on_cluster(tasks, after, scheduler)
    return _here(tasks) if jobs == 1 else _in_processes(tasks, after, jobs)


def _here(tasks: Sequence[Task]) -> Iterator[tuple[int, Took]]:
    for number, task in enumerate(tasks):
        yield number, perform(task)


def _in_processes(tasks: Sequence[Task], after: Sequence[Collection[int]], jobs: int) -> Iterator[tuple[int, Took]]:
    done = set[int]()
    for attempt in range(ATTEMPTS):
        again = False
        # Tasks that were done before find their results, and return at once.
        with closing(run_isolated(_attempt, tasks, jobs, after=after)) as outcomes:
            for outcome in outcomes:
                if isinstance(outcome.result, HdpeaError):
                    raise outcome.result
                if outcome.result is not None:
                    if outcome.index not in done:
                        done.add(outcome.index)
                        yield outcome.index, outcome.result
                elif outcome.died and attempt + 1 < ATTEMPTS:
                    again = True
                else:
                    raise HdpeaError(f"{_name(tasks[outcome.index])} failed: {outcome.failed}")
        if not again:
            return


def _on_cluster(tasks: Sequence[Task], after: Sequence[Collection[int]], scheduler: str) -> Iterator[tuple[int, Took]]:
    try:
        from distributed import Client, as_completed
    except ImportError as error:
        raise UsageError("A `scheduler` needs Dask.", "pip install 'hdpea[cluster]'") from error
    try:
        client = Client(scheduler, timeout="10s")
    except (OSError, ValueError) as error:
        raise UsageError(f"There is no Dask scheduler at {scheduler}: {error}.", "Start one: dask scheduler") from error
    with client:
        futures = list[Any]()
        for task, earlier in zip(tasks, after, strict=True):
            waited_for = [futures[each] for each in sorted(earlier)]
            futures.append(client.submit(_perform_after, task, waited_for, pure=False, retries=ATTEMPTS - 1))
        numbers = {future.key: number for number, future in enumerate(futures)}
        for future in as_completed(futures):
            if future.status != "finished":
                why = future.exception()
                failed = HdpeaError(f"{_name(tasks[numbers[future.key]])} failed: {why}")
                raise why if isinstance(why, HdpeaError) else failed
            yield numbers[future.key], future.result()


def _attempt(task: Task) -> Took | HdpeaError:
    """Do a task in a process of its own, which hands its errors on as they are."""
    try:
        return perform(task)
    except HdpeaError as error:
        return error


def _perform_after(task: Task, _: Sequence[Took]) -> Took:
    """Do a task; the results of those that it waits for are files."""
    return perform(task)


def _name(task: Task) -> str:
    return f"The stage {task.stage}" + ("" if task.number is None else f" of tile {task.number}")
