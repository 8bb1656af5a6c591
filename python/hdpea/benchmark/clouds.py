# SPDX-License-Identifier: GPL-3.0-or-later
"""The clouds that every method of a suite is given."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.suite import SuiteInput
from hdpea.dataset.build import seed_of
from hdpea.dataset.degradation import degraded
from hdpea.dataset.normal_estimation import estimated_normals
from hdpea.dataset.options import DatasetOptions, SamplingOptions
from hdpea.dataset.sample import Sample
from hdpea.dataset.sample_generation import draw_points
from hdpea.geometry.triangles import TriangleMesh
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.runtime.outputs import replacing
from hdpea.writing.points import point_ply

Rows = NDArray[np.float64]


def make_cloud(surface: TriangleMesh, model: str, given: SuiteInput, seed: int) -> Cloud:
    """Sample or scan a surface in world units, and degrade the points; the same for the same names and seed.

    Normals are the true ones, unless the input asks for normals estimated from the points.

    Raises
    ------
    CannotReconstruct
        If no sensor sees the surface, or it has no area.
    UsageError
        If a scan is requested and embreex is missing; if no points remain.
    """
    seed = seed_of(model, seed)
    frame = UnitFrame.around(surface[0])
    wanted = DatasetOptions(given.sample, SamplingOptions(points=given.scan.points), given.scan)
    points, surface_points, normals, _ = draw_points(frame.to_unit(surface[0]), surface[1], wanted, seed)
    sample = bare_sample(points, surface_points, normals, frame)
    worse = degraded(sample, replace(given.degradation, seed=seed))
    if given.sample.estimate:
        worse = replace(worse, estimated_normals=estimated_normals(worse.points))
    return cloud_of(worse, model, given)


def bare_sample(points: Rows, surface_points: Rows, normals: Rows, frame: UnitFrame) -> Sample:
    """Return a sample of points, their true points of the surface, and normals, each (n, 3) in the unit frame.

    It has no embedding, since no method is given one.
    """
    nothing = np.zeros((len(points), 0), np.float32)
    return Sample(
        points=points.astype(np.float32),
        surface_points=surface_points.astype(np.float32),
        normals=normals.astype(np.float32),
        psi=nothing,
        curvatures=nothing,
        direction1=nothing,
        frame=frame,
    )


def cloud_of(sample: Sample, model: str, given: SuiteInput) -> Cloud:
    """Return the input of the methods: points in world units, with the estimated normals if there are any."""
    normals = sample.normals if sample.estimated_normals is None else sample.estimated_normals
    points = sample.frame.to_world(sample.points.astype(np.float64))
    return Cloud(points, normals.astype(np.float64), model, given.name)


def write_cloud(path: Path, cloud: Cloud) -> None:
    """Write the cloud as PLY, also for methods that run elsewhere."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as partial:
        partial.write_bytes(point_ply(cloud.points, cloud.normals, {}))
