# SPDX-License-Identifier: GPL-3.0-or-later
"""Tensors as ellipsoids: long along the surface's smaller curvature, as triangles of the metric are."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.curvature.tensors import CurvatureTensors
from hdpea.errors import core_errors_translated
from hdpea.geometry.tensors import frames
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.pictures.colors import UNDETERMINED, Colors, ratio_colors

Rows = NDArray[np.float64]

CANDIDATES = 50_000
"""Most points that glyphs are chosen from: enough for any picture, and fast."""

FILLING = 0.5
"""Radius of a round glyph in distances of neighbouring glyphs: they just touch."""

THICKNESS = 0.3
"""Of a glyph along the normal, in radii of a round one."""

PLATE = 2.0
"""Radius, in radii of round glyphs, of the disk below each glyph that hides what lies behind the surface."""

LONGEST = 2.5
"""Half length of the longest glyph in the same radii: beyond it, only the colour shows the ratio."""

REDDEST = 95
"""Percentile of the ratios, where determined, from which the colour is red; but at least ``LEAST_RED``."""

LEAST_RED = 1.5


@dataclass(frozen=True)
class Glyphs:
    """Ellipsoids in the unit frame of their cloud.

    Attributes
    ----------
    centres, normals
        (m, 3) float64.
    axes
        (m, 3, 3) float64: half axes as rows, along direction 1, direction 2 and the normal.
    colors
        (m, 3) uint8, of the stretching ratio, grey where the directions are not determined.
    ratios
        (m,) float64: the stretching ratio, NaN where the directions are not determined.
    most
        The stretching ratio from which the colour is red.
    radius
        Of a round glyph.
    frame
        The unit frame.
    """

    centres: Rows
    normals: Rows
    axes: Rows
    colors: Colors
    ratios: Rows
    most: float
    radius: float
    frame: UnitFrame


def glyphs_of(tensors: CurvatureTensors, count: int) -> Glyphs:
    """Return glyphs for up to `count` of the points, spread evenly.

    The axes in the surface are as 1 / s1 to 1 / s2, and the area is the same for all.
    """
    frame = UnitFrame.around(tensors.points)
    points = frame.to_unit(tensors.points)
    candidates = np.arange(0, len(points), -(-len(points) // CANDIDATES))
    with core_errors_translated():
        nearby = np.ascontiguousarray(points[candidates])
        chosen = candidates[_core.farthest_point_sampling(nearby, min(count, len(candidates)))]
        centres = np.ascontiguousarray(points[chosen])
        nearest = _core.nearest_neighbors(centres, 1)[:, 0]
    radius = FILLING * float(np.median(np.linalg.norm(centres[nearest] - centres, axis=1)))
    determined, normals = tensors.determined[chosen], tensors.normals[chosen]
    ratio = np.where(determined, tensors.stretching_ratio[chosen], 1.0)
    length = np.sqrt(ratio).clip(max=LONGEST)
    direction1 = np.where(determined[:, None], tensors.direction1[chosen], _tangents(normals))
    half_axes = radius * np.column_stack([1 / length, length, np.full(len(chosen), THICKNESS)])
    most = max(LEAST_RED, float(np.percentile(ratio[determined], REDDEST))) if determined.any() else LEAST_RED
    colored = ratio_colors(ratio, most)
    colors = np.where(determined[:, None], colored, np.rint(255 * np.array(UNDETERMINED))).astype(np.uint8)
    axes = half_axes[:, :, None] * frames(normals, direction1)
    return Glyphs(centres, normals, axes, colors, np.where(determined, ratio, np.nan), most, radius, frame)


def _tangents(normals: Rows) -> Rows:
    """Return a unit vector (m, 3) across each normal."""
    least = np.eye(3)[abs(normals).argmin(axis=1)]
    across = np.cross(normals, least)
    return np.asarray(across / np.linalg.norm(across, axis=1, keepdims=True))
