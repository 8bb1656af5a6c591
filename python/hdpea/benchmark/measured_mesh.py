# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh, and what it took to make it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from hdpea.reading.triangle_mesh import TriangleMesh
from hdpea.runtime.clock import cpu_seconds, peak_of_programs_bytes, peak_resident_bytes


@dataclass(frozen=True)
class MeasuredMesh:
    """A mesh; seconds on the clock, and of all cores together; the peak memory of the process, in bytes."""

    mesh: TriangleMesh
    seconds: float
    cpu_seconds: float
    peak_bytes: int

    def then(self, last: MeasuredMesh) -> MeasuredMesh:
        """Return what came out `last`, and what both steps took together."""
        peak = max(self.peak_bytes, last.peak_bytes)
        return MeasuredMesh(last.mesh, self.seconds + last.seconds, self.cpu_seconds + last.cpu_seconds, peak)


def measured(make: Callable[[], TriangleMesh]) -> MeasuredMesh:
    """Make a mesh, and measure that, programs that it runs included."""
    started, worked, largest = time.perf_counter(), cpu_seconds(), peak_of_programs_bytes()
    mesh = make()
    seconds, cpu = time.perf_counter() - started, cpu_seconds() - worked
    programs = peak_of_programs_bytes()
    # No larger than before: it may be that of a compiler that ran for something else.
    peak = max(peak_resident_bytes(), programs if programs > largest else 0)
    return MeasuredMesh(mesh, seconds, cpu, peak)
