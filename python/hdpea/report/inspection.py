# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in a point cloud, and what making a mesh of it would take."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.unit_frame import UnitFrame, diagonal_of
from hdpea.options import MeshingOptions
from hdpea.reading import PointCloud
from hdpea.report.cost import PEAK_BYTES, seconds_of_run
from hdpea.surface.normals import ORIENTATION_NEIGHBORS
from hdpea.surface.orientation import TRUSTED_CONSISTENCY
from hdpea.surface.surface import median_spacing


@dataclass(frozen=True)
class CloudFacts:
    """What ``hdpea info`` says about a cloud; lengths are in the units of the file.

    ``spacing`` is the median distance to the nearest other point. ``normal_agreement`` is the share
    of neighbouring points whose normals point to the same side, by which a run decides whether to
    orient them anew, which takes time. Both are None where there is nothing to compare. The estimates
    are for the default number of vertices.
    """

    format: str
    counts: dict[str, int]
    attributes: list[str]
    low: list[float]
    high: list[float]
    diagonal: float
    spacing: float | None
    normal_agreement: float | None
    default_vertices: int
    estimated_seconds: float
    estimated_peak_bytes: float
    notes: list[str]


def inspect(cloud: PointCloud) -> CloudFacts:
    """Look at a cleaned cloud."""
    low, high = cloud.points.min(axis=0), cloud.points.max(axis=0)
    vertices = MeshingOptions().vertices_of(len(cloud.points))
    diagonal = diagonal_of(low, high)
    spacing, agreement = _compare_neighbors(cloud) if 0 < diagonal < np.inf else (None, None)
    oriented = agreement is not None and agreement >= TRUSTED_CONSISTENCY
    return CloudFacts(
        format=cloud.format,
        counts=cloud.counts(),
        attributes=list(cloud.attributes),
        low=low.tolist(),
        high=high.tolist(),
        diagonal=diagonal,
        spacing=spacing,
        normal_agreement=agreement,
        default_vertices=vertices,
        estimated_seconds=seconds_of_run(len(cloud.points), vertices, oriented),
        estimated_peak_bytes=PEAK_BYTES.of(len(cloud.points), vertices),
        notes=list(cloud.notes),
    )


def _compare_neighbors(cloud: PointCloud) -> tuple[float, float | None]:
    frame = UnitFrame.around(cloud.points)
    points = frame.to_unit(cloud.points)
    with core_errors_translated():
        neighbors = _core.nearest_neighbors(points, ORIENTATION_NEIGHBORS)
        spacing = frame.diagonal * median_spacing(points, neighbors)
        if cloud.normals is None:
            return spacing, None
        return spacing, _core.orientation_consistency(points, cloud.normals, neighbors)
