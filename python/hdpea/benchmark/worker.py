# SPDX-License-Identifier: GPL-3.0-or-later
"""A method run on a cloud, in a process of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from hdpea.benchmark.measured_mesh import MeasuredMesh, measured
from hdpea.benchmark.methods import METHODS, Cloud, libraries, method_options
from hdpea.benchmark.methods.reduction import reduced
from hdpea.benchmark.surface_cache import cached_surface
from hdpea.errors import CannotReconstruct
from hdpea.reading.triangle_mesh import drop_unused
from hdpea.runtime.processes import Outcome, run_isolated


@dataclass(frozen=True)
class Task:
    """What the process needs; `surfaces` is the folder of the surfaces that several reductions share."""

    cloud: Cloud
    method: str
    values: Mapping[str, Any]
    vertices: int
    surfaces: Path


def run_method_isolated(task: Task, time_limit: float) -> Outcome[MeasuredMesh]:
    """Run a method in a fresh process, so that crashes, memory and time are its own."""
    return next(run_isolated(run_method, [task], jobs=1, time_limit=time_limit))


def run_method(task: Task) -> MeasuredMesh:
    """Run a method in this process; the cost is measured after its libraries have been loaded.

    Raises
    ------
    CannotReconstruct
        If the result has no triangles.
    """
    options = method_options(task.method, task.values)
    method = METHODS[task.method]
    for library in libraries(task.method, options):
        import_module(library)
    if method.reduces:
        surface = cached_surface(task.cloud, task.method, options, task.surfaces)
        made = surface.then(measured(lambda: reduced(surface.mesh, task.vertices, options.reduce)))
    else:
        reconstruct = method.load("reconstruct")
        made = measured(lambda: reconstruct(task.cloud, task.vertices, options))
    vertices, faces = made.mesh
    if len(faces) == 0 or not np.isfinite(vertices).all():
        raise CannotReconstruct("The method made no triangles.", "See its options.")
    return MeasuredMesh(drop_unused(vertices, faces), made.seconds, made.cpu_seconds, made.peak_bytes)
