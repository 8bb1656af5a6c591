# SPDX-License-Identifier: GPL-3.0-or-later
"""Generation of a sample from a mesh: points on it, or of a scan of it, and the truth at each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.ground_truth import embed_mesh
from hdpea.dataset.normal_estimation import estimated_normals
from hdpea.dataset.options import DatasetOptions
from hdpea.dataset.sample import Sample
from hdpea.dataset.scanning import scan_surface
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.runtime.progress import ProgressCallback, tell

Rows = NDArray[np.float64]


def make_sample(
    vertices_in_world: Rows,
    faces: NDArray[np.int64],
    options: DatasetOptions,
    seed: int,
    progress: ProgressCallback | None = None,
) -> Sample:
    """Return a sample of the closed surface `vertices_in_world` (v, 3), `faces` (f, 3), normals outward.

    Raises
    ------
    CannotReconstruct
        If the surface cannot be embedded, or has no area.
    """
    frame = UnitFrame.around(vertices_in_world)
    # Points first: an error there should not come after the minute that the truth takes.
    tell(progress, "points", 0.0)
    points, surface_points, normals, sensors = draw_points(frame.to_unit(vertices_in_world), faces, options, seed)
    estimated = estimated_normals(points) if options.sample.estimate else None
    truth = embed_mesh(vertices_in_world, faces, options.ground_truth, progress).at(surface_points)
    return Sample(
        points=points.astype(np.float32),
        surface_points=surface_points.astype(np.float32),
        normals=normals.astype(np.float32),
        psi=truth.psi.astype(np.float32),
        curvatures=truth.curvatures.astype(np.float32),
        direction1=truth.direction1.astype(np.float32),
        frame=frame,
        estimated_normals=estimated,
        sensors=None if sensors is None else sensors.astype(np.float32),
    )


def draw_points(
    vertices: Rows, faces: NDArray[np.int64], options: DatasetOptions, seed: int
) -> tuple[Rows, Rows, Rows, Rows | None]:
    """Return points, the true points of the surface, normals, and the positions of the sensor, if scanned."""
    if options.sample.kind == "scan":
        scan = scan_surface(vertices, faces, replace(options.scanning, seed=seed))
        return scan.points, scan.surface_points, scan.normals, scan.sensors
    drawn = sample_surface(vertices, faces, options.sampling.points, method=options.sample.kind, seed=seed)
    return drawn.points, drawn.points, drawn.normals, None
