# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of a run: how stages tell it, and how people see it."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext

from hdpea.errors import Interrupted

ProgressCallback = Callable[[str, float], object]
"""What users give: a function of the name of a phase and the fraction of it done, in [0, 1].

It asks to stop by returning False, or whatever else is false (0, ``numpy.False_``); None, which a function without a
return statement returns, goes on. See ``goes_on``.
"""

PhaseCallback = Callable[[float], bool]
"""The same for one phase, of which it knows the name: what stages and the core are given, see ``of_phase``."""


def goes_on(answer: object) -> bool:
    """Say whether the run goes on after a callback has returned `answer`; bindings/bindings.hpp has the same rule."""
    return answer is None or bool(answer)


def tell(progress: ProgressCallback | None, phase: str, fraction: float) -> None:
    """Report progress from a Python stage; raise ``Interrupted`` if the callback asks to stop."""
    if not of_phase(progress, phase)(fraction):
        raise Interrupted


def of_phase(progress: ProgressCallback | None, phase: str) -> PhaseCallback:
    """Return the callback for one phase."""
    return lambda fraction: progress is None or goes_on(progress(phase, fraction))


def shown(quiet: bool = False) -> AbstractContextManager[ProgressCallback | None]:
    """Show progress on standard error: bars on a terminal, else a line per phase; nothing if `quiet`."""
    if quiet:
        return nullcontext()
    return _bars() if sys.stderr.isatty() else _lines()


@contextmanager
def _lines() -> Iterator[ProgressCallback]:
    current, started = "", 0.0

    def end() -> None:
        if current:
            sys.stderr.write(f" {time.perf_counter() - started:.1f} s\n")

    def show(phase: str, _: float) -> bool:
        nonlocal current, started
        if phase != current:
            end()
            current, started = phase, time.perf_counter()
            sys.stderr.write(f"{phase} ...")
            sys.stderr.flush()
        return True

    try:
        yield show
    finally:
        end()


@contextmanager
def _bars() -> Iterator[ProgressCallback]:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TaskID, TaskProgressColumn, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True)) as bars:
        tasks: dict[str, TaskID] = {}

        def complete_all() -> None:
            for task in tasks.values():
                bars.update(task, completed=1.0)

        def show(phase: str, fraction: float) -> bool:
            if phase not in tasks:
                complete_all()
                tasks[phase] = bars.add_task(phase, total=1.0)
            bars.update(tasks[phase], completed=fraction)
            return True

        yield show
        complete_all()
