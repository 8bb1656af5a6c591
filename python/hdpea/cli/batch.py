# SPDX-License-Identifier: GPL-3.0-or-later
"""Many clouds, a mesh of each: each in a process of its own, so that what one breaks breaks no other."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from hdpea.cli.ended import Ended
from hdpea.cli.job import Job, attempt
from hdpea.errors import CannotReconstruct, HdpeaError, QualityMissed, UnreadableInput, UsageError
from hdpea.options.settings import as_dict
from hdpea.runtime.outputs import unfinished_folder
from hdpea.runtime.processes import Outcome, run_isolated

BY_GRAVITY = (QualityMissed, UsageError, UnreadableInput, CannotReconstruct, HdpeaError)
"""From the least grave: a mesh that is not as asked for is better than none, and a mistake of hdpea is the worst."""


def meshes_of_each(jobs: Sequence[Job], parallel: int, out_dir: Path) -> Iterator[Ended]:
    """Do the jobs, `parallel` at a time; yield what became of each as it ends.

    The processes write into a folder that vanishes with whatever is half-written there; finished files are moved
    into `out_dir`.
    """
    threads = max((os.cpu_count() or 1) // parallel, 1)
    with unfinished_folder(out_dir) as folder:
        tasks = [_task(job, folder / str(index), threads) for index, job in enumerate(jobs)]
        with closing(run_isolated(attempt, tasks, parallel, fresh=True)) as outcomes:
            for outcome in outcomes:
                for written in (folder / str(outcome.index)).iterdir():
                    written.replace(out_dir / written.name)
                yield _ended(jobs[outcome.index], outcome)


def _task(job: Job, folder: Path, threads: int) -> Job:
    """Return the same job, done in a folder of its own and with its share of the processors."""
    folder.mkdir()
    output = job.destination.output
    destination = replace(job.destination, output=output and folder / output.name)
    options = job.options if job.options.threads else replace(job.options, threads=threads)
    return replace(job, destination=destination, options=options)


def _ended(job: Job, outcome: Outcome[Ended]) -> Ended:
    output = str(job.destination.output)
    if outcome.result is None:
        hint = "Reconstruct it alone to see more."
        return Ended(job.destination.sources, output, kind=HdpeaError, message=outcome.failed, hint=hint)
    hint = f"The mesh is in {output} all the same." if outcome.result.kind is QualityMissed else outcome.result.hint
    # Its share of the processors was not asked for, and is another on another machine.
    report = outcome.result.report and outcome.result.report | {"options": as_dict(job.options)}
    return replace(outcome.result, report=report, output=output, hint=hint)


def worst_of(all_ended: Sequence[Ended]) -> HdpeaError | None:
    """Return the gravest kind of error of a batch, as one error for the whole; None if there was none."""
    failed = [ended for ended in all_ended if ended.kind is not None]
    if not failed:
        return None
    kind = max((ended.kind for ended in failed if ended.kind), key=BY_GRAVITY.index)
    names = ", ".join(source for ended in failed for source in ended.sources)
    return kind(f"{len(failed)} of {len(all_ended)} went wrong: {names}.", "What is wrong with each is told above.")
