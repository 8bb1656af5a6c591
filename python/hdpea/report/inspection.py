# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in a point cloud, and what making a mesh of it would take."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.frontend.cleaning import surface_cloud
from hdpea.frontend.vantage import with_sensor_found
from hdpea.geometry.unit_frame import UnitFrame, diagonal_of
from hdpea.options import MeshingOptions
from hdpea.reading import PointCloud
from hdpea.reading.attributes import classes_of
from hdpea.report.cost import PEAK_BYTES, seconds_of_run
from hdpea.surface.given_signs import GivenSigns, given_signs
from hdpea.surface.normals import ORIENTATION_NEIGHBORS
from hdpea.surface.plausibility import are_normals
from hdpea.surface.surface import median_spacing


@dataclass(frozen=True)
class CloudFacts:
    """What ``hdpea info`` says about a cloud; lengths are in the units of the file.

    ``counts`` are those of a run: what was dropped on reading, and what a run will leave out. ``spacing`` is the median
    distance to the nearest other point, ``surface_spacing`` how far apart the surface is sampled: more, where points
    lie on scan lines. ``normals_fit`` tells whether the normals lie across the surface, or else will be estimated.
    ``normal_agreement`` is the share of neighbouring points whose normals point to the same side, by which a run
    decides whether to orient them anew, which takes time, unless they contradict each other patch by patch
    (``normals_oriented``). ``classes`` has how many points are of each. Each is None where there is nothing to compare.
    The estimates are for the default number of vertices.
    """

    format: str
    counts: dict[str, int]
    attributes: list[str]
    classes: dict[int, int] | None
    low: list[float]
    high: list[float]
    diagonal: float
    spacing: float | None
    surface_spacing: float | None
    normals_fit: bool | None
    normal_agreement: float | None
    normals_oriented: bool | None
    default_vertices: int
    estimated_seconds: float
    estimated_peak_bytes: float
    crs: str | None
    notes: list[str]


def inspect(cloud: PointCloud) -> CloudFacts:
    """Look at a cleaned cloud."""
    low, high = cloud.points.min(axis=0), cloud.points.max(axis=0)
    diagonal = diagonal_of(low, high)
    found = surface_cloud(with_sensor_found(cloud))
    vertices = MeshingOptions().vertices_of(found.points_shown)
    left = len(found.cloud.points)
    spacing, fit, signs = _compare_neighbors(cloud) if 0 < diagonal < np.inf else (None, None, None)
    oriented = None if fit is None or signs is None else fit and signs.trusted
    return CloudFacts(
        format=cloud.format,
        counts=cloud.counts() | found.counts(),
        attributes=list(cloud.attributes),
        classes=_points_of_classes(cloud),
        low=low.tolist(),
        high=high.tolist(),
        diagonal=diagonal,
        spacing=spacing,
        surface_spacing=found.spacing,
        normals_fit=fit,
        normal_agreement=None if signs is None else signs.consistency,
        normals_oriented=oriented,
        default_vertices=vertices,
        estimated_seconds=seconds_of_run(left, vertices),
        estimated_peak_bytes=PEAK_BYTES.of(left, vertices),
        crs=cloud.crs,
        notes=[*found.cloud.notes, *found.notes],
    )


def _points_of_classes(cloud: PointCloud) -> dict[int, int] | None:
    classes = classes_of(cloud.attributes)
    if classes is None:
        return None
    numbers, counts = np.unique(classes, return_counts=True)
    return dict(zip(numbers.tolist(), counts.tolist(), strict=True))


def _compare_neighbors(cloud: PointCloud) -> tuple[float, bool | None, GivenSigns | None]:
    """Return the spacing, whether normals lie across the surface, and what is thought of their signs."""
    frame = UnitFrame.around(cloud.points)
    points = frame.to_unit(cloud.points)
    with core_errors_translated():
        neighbors = _core.nearest_neighbors(points, ORIENTATION_NEIGHBORS)
        spacing = frame.diagonal * median_spacing(points, neighbors)
        if cloud.normals is None:
            return spacing, None, None
        signs = given_signs(points, cloud.normals, neighbors)
        return spacing, are_normals(points, cloud.normals), signs
