# SPDX-License-Identifier: GPL-3.0-or-later
"""Quick stand-ins for the stages behind the command line, so that its tests test it alone."""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from hdpea.options import Options
from hdpea.options.choice import Choice
from hdpea.reading.cloud import PointCloud
from hdpea.report.achieved_error import AchievedError
from hdpea.report.agreement import Agreement
from hdpea.report.facts import Distances, MeshFacts
from hdpea.report.report import Journal, Report
from hdpea.result import Reconstruction
from hdpea.runtime.progress import ProgressCallback, tell

Array = NDArray[np.float64]

NO_ERROR = AchievedError(None, 0.0, 0.0, 0.0)
ONE_TRIANGLE = MeshFacts(
    3, 1, manifold=True, closed=False, components=1, boundary_loops=1, genus=None, self_intersections=0
)


@dataclass
class Embedding:
    points: Array
    normals: Array
    coordinates: Array
    choices: tuple[Choice, ...] = ()


def reconstruct(cloud: PointCloud, options: Options, progress: ProgressCallback | None) -> Reconstruction:
    """Return one triangle; fail or dawdle if the seed says so."""
    tell(progress, "meshing", 0.0)
    if options.particles.seed == FAILING_SEED:
        raise ZeroDivisionError("a bug")
    if options.particles.seed == SLEEPING_SEED:
        time.sleep(60)
    journal = Journal(options=options, counts=cloud.counts(), notes=list(cloud.notes))
    journal.choices.append(Choice("vertices", 3, "", "the smallest mesh"))
    if options.meshing.watertight:
        journal.missed.append("The mesh has 1 hole.")
    report = Report.of(journal, ONE_TRIANGLE, Distances.of(np.zeros(1), spacing=1.0), Agreement(0.0, 0.0), NO_ERROR)
    return Reconstruction(cloud.points[:3], np.array([[0, 1, 2]]), report)


def embed_points(cloud: PointCloud, options: Options, progress: ProgressCallback | None) -> Embedding:  # noqa: ARG001
    """Return the points, padded with zeros."""
    tell(progress, "embedding", 0.0)
    points = cloud.points
    return Embedding(points, np.zeros_like(points), np.pad(points, ((0, 0), (0, 5))), np.arange(len(points)))


FAILING_SEED, SLEEPING_SEED = 13, 14


def install() -> None:
    """Take the places of the real modules in this process."""
    for name, function in {"hdpea.reconstruction": reconstruct, "hdpea.embedding": embed_points}.items():
        module = ModuleType(name)
        setattr(module, function.__name__, function)
        sys.modules[name] = module


if __name__ == "__main__":
    install()
    from hdpea.cli import main

    main()
