# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in a point cloud, and what making a mesh of it would take."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.estimates import PEAK_BYTES, SECONDS
from hdpea.options import POINTS_PER_VERTEX
from hdpea.reading import PointCloud

NEIGHBORS = 6
"""Neighbours whose normals are compared with the point's."""


@dataclass(frozen=True)
class CloudFacts:
    """What ``hdpea info`` says about a cloud; lengths are in the units of the file.

    ``spacing`` is the median distance to the nearest other point. ``normal_agreement`` is the share
    of neighbouring points whose normals point to the same side, 1 for a consistent orientation. Both
    are None where there is nothing to compare. The estimates are for the default number of vertices.
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
    vertices = max(4, len(cloud.points) // POINTS_PER_VERTEX)
    spacing, agreement = _compare_neighbors(cloud) if len(cloud.points) > 1 else (None, None)
    return CloudFacts(
        format=cloud.format,
        counts=cloud.counts(),
        attributes=list(cloud.attributes),
        low=low.tolist(),
        high=high.tolist(),
        diagonal=float(np.linalg.norm(high - low)),
        spacing=spacing,
        normal_agreement=agreement,
        default_vertices=vertices,
        estimated_seconds=SECONDS.of(len(cloud.points), vertices),
        estimated_peak_bytes=PEAK_BYTES.of(len(cloud.points), vertices),
        notes=list(cloud.notes),
    )


def _compare_neighbors(cloud: PointCloud) -> tuple[float, float | None]:
    # Differences of large coordinates lose digits, so the origin comes to the cloud first.
    centered = cloud.points - cloud.points.mean(axis=0)
    with core_errors_translated():
        neighbors = _core.nearest_neighbors(centered, min(NEIGHBORS, len(centered) - 1))
    spacing = float(np.median(np.linalg.norm(centered[neighbors[:, 0]] - centered, axis=1)))
    if cloud.normals is None:
        return spacing, None
    cosines = np.einsum("nkc,nc->nk", cloud.normals[neighbors], cloud.normals)
    compared = cosines[cosines != 0]
    return spacing, float(np.mean(compared > 0)) if len(compared) else None
