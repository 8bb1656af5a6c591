# SPDX-License-Identifier: GPL-3.0-or-later
"""What each stage of a run takes: time and memory."""

from __future__ import annotations

import resource
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

_CLEAR_REFS = Path("/proc/self/clear_refs")
_STATUS = Path("/proc/self/status")

_highest_before = 0
"""Peak of this process in bytes, until it was last reset."""


@dataclass
class Stage:
    """The measurement of one stage: wall-clock time, and peak resident memory of the process meanwhile.

    ``level`` is the number of stages around it; those of level 0 make up the run.
    """

    name: str
    level: int
    seconds: float = 0.0
    peak_bytes: int = 0


class StageClock:
    """Measures the stages of a run, in order.

    Examples
    --------
    >>> clock = StageClock()
    >>> with clock.stage("embedding"):
    ...     pass
    >>> [stage.name for stage in clock.stages]
    ['embedding']

    Stages may be nested; an outer stage includes the inner ones. Where the system cannot reset its
    peak (other systems than Linux), the peak of a stage is that of the process until its end.
    """

    def __init__(self) -> None:
        self.stages: list[Stage] = []
        self._open: list[Stage] = []

    @contextmanager
    def stage(self, name: str) -> Iterator[Stage]:
        """Measure the body of the ``with`` as a stage."""
        stage = Stage(name, len(self._open))
        self.stages.append(stage)
        self._sample()
        self._open.append(stage)
        started = time.perf_counter()
        try:
            yield stage
        finally:
            stage.seconds = time.perf_counter() - started
            self._sample()
            self._open.remove(stage)

    def total(self) -> Stage:
        """Return the run as a whole: seconds add up, the peak is the highest."""
        outer = [stage for stage in self.stages if stage.level == 0]
        peak_bytes = max((stage.peak_bytes for stage in outer), default=0)
        return Stage("total", 0, sum(stage.seconds for stage in outer), peak_bytes)

    def _sample(self) -> None:
        """Credit the peak since the last sample to the open stages, and begin a new one."""
        peak = peak_resident_bytes()
        for stage in self._open:
            stage.peak_bytes = max(stage.peak_bytes, peak)
        _reset_peak()


def peak_resident_bytes() -> int:
    """Return the peak resident memory of this process since it was last reset, or since its start."""
    try:
        status = _STATUS.read_text()
    except OSError:
        return _largest_bytes(resource.RUSAGE_SELF)
    return next(int(line.split()[1]) * 1024 for line in status.splitlines() if line.startswith("VmHWM"))


def peak_of_process_bytes() -> int:
    """Return the peak resident memory of this process since its start, however often stages have reset it."""
    return max(_highest_before, peak_resident_bytes())


def cpu_seconds() -> float:
    """Return the processor time of this process, all threads together, and of programs it ran that have ended."""
    programs = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + programs.ru_utime + programs.ru_stime


def peak_of_programs_bytes() -> int:
    """Return the peak resident memory of the largest program that this process ran and that has ended."""
    return _largest_bytes(resource.RUSAGE_CHILDREN)


def _largest_bytes(who: int) -> int:
    return resource.getrusage(who).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def _reset_peak() -> None:
    global _highest_before  # noqa: PLW0603 - as there is one peak of the process, however many clocks
    _highest_before = peak_of_process_bytes()
    try:
        _CLEAR_REFS.write_text("5")
    except OSError:
        return
