# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh, and what it took to make it."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from hdpea.measuring import peak_resident_bytes
from hdpea.reading.triangle_mesh import TriangleMesh


@dataclass(frozen=True)
class Made:
    """A mesh; seconds on the clock, and of all cores together; the peak memory of the process, in bytes."""

    mesh: TriangleMesh
    seconds: float
    cpu_seconds: float
    peak_bytes: int

    def then(self, last: Made) -> Made:
        """Return what came out `last`, and what both steps took together."""
        peak = max(self.peak_bytes, last.peak_bytes)
        return Made(last.mesh, self.seconds + last.seconds, self.cpu_seconds + last.cpu_seconds, peak)


def made_by(make: Callable[[], TriangleMesh]) -> Made:
    """Make a mesh, and measure that."""
    started, worked = time.perf_counter(), time.process_time()
    mesh = make()
    return Made(mesh, time.perf_counter() - started, time.process_time() - worked, peak_resident_bytes())
