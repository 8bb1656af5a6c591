# SPDX-License-Identifier: GPL-3.0-or-later
"""One method on one cloud, in a process of its own."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np

from hdpea.benchmark.methods import METHODS, Cloud, libraries, method_options
from hdpea.dataset.isolation import Outcome, run_isolated
from hdpea.errors import CannotReconstruct
from hdpea.reading.triangle_mesh import TriangleMesh, drop_unused


@dataclass(frozen=True)
class Task:
    """What the process needs to know."""

    cloud: Cloud
    method: str
    values: Mapping[str, Any]
    vertices: int


@dataclass(frozen=True)
class Made:
    """The mesh that came out, and what it took; its libraries were loaded before."""

    mesh: TriangleMesh
    seconds: float
    cpu_seconds: float
    peak_bytes: int


def run(task: Task, time_limit: float) -> Outcome[Made]:
    """Run a method in a fresh process: its crash, its memory and its time are its own."""
    return next(run_isolated(work, [task], jobs=1, time_limit=time_limit))


def work(task: Task) -> Made:
    """Run a method in this process.

    Raises
    ------
    CannotReconstruct
        If it makes no triangle.
    """
    from hdpea.measuring import peak_resident_bytes

    options = method_options(task.method, task.values)
    reconstruct = METHODS[task.method].load()
    for library in libraries(task.method, options):
        import_module(library)
    started, worked = time.perf_counter(), time.process_time()
    vertices, faces = reconstruct(task.cloud, task.vertices, options)
    seconds, cpu_seconds = time.perf_counter() - started, time.process_time() - worked
    peak = peak_resident_bytes()
    if len(faces) == 0 or not np.isfinite(vertices).all():
        raise CannotReconstruct("The method made no triangles.", "See its options.")
    return Made(drop_unused(vertices, faces), seconds, cpu_seconds, peak)
