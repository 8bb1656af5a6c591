# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh with the time and memory that making it took."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from hdpea.geometry.triangles import TriangleMesh
from hdpea.runtime.clock import cpu_seconds, peak_of_process_bytes, peak_of_programs_bytes


@dataclass(frozen=True)
class MeasuredMesh:
    """A mesh, the elapsed seconds, the CPU seconds of all cores, and the peak memory of the process in bytes."""

    mesh: TriangleMesh
    seconds: float
    cpu_seconds: float
    peak_bytes: int

    def then(self, following: MeasuredMesh) -> MeasuredMesh:
        """Return the mesh of the step after this one, with the cost of both steps."""
        peak = max(self.peak_bytes, following.peak_bytes)
        return MeasuredMesh(
            following.mesh, self.seconds + following.seconds, self.cpu_seconds + following.cpu_seconds, peak
        )


def measured(make: Callable[[], TriangleMesh]) -> MeasuredMesh:
    """Make a mesh and measure the cost, including that of programs it runs."""
    started, worked, largest = time.perf_counter(), cpu_seconds(), peak_of_programs_bytes()
    mesh = make()
    seconds, cpu = time.perf_counter() - started, cpu_seconds() - worked
    programs = peak_of_programs_bytes()
    # If it has not grown, it may be that of another program, such as a compiler.
    peak = max(peak_of_process_bytes(), programs if programs > largest else 0)
    return MeasuredMesh(mesh, seconds, cpu, peak)
