# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors as a page: ellipsoids on the points, and the points in colours."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hdpea.curvature.glyphs import PLATE, glyphs_of
from hdpea.curvature.tensors import CurvatureTensors
from hdpea.geometry.thinning import thinned
from hdpea.pages.colorings import MOST_POINTS
from hdpea.pages.page import write_page as write_shapes
from hdpea.pages.shapes import Coloring, EllipsoidShape, PointShape

GLYPHS = 4_000
"""Most ellipsoids."""

RATIO = "stretching ratio"


def write_page(path: Path, tensors: CurvatureTensors, title: str = "curvature") -> None:
    """Write the ellipsoids of ``draw_curvature`` as a page that needs nothing but a browser with WebGL.

    Parameters
    ----------
    path
        An HTML file, replaced only once the new one is complete.
    title
        Of the page.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    glyphs = glyphs_of(tensors, GLYPHS)
    diagonal, most = glyphs.frame.diagonal, glyphs.most
    note = "Stretch along direction 1 over that along direction 2; grey: flat or round, any direction."
    ratio = Coloring(RATIO, glyphs.ratios, 1.0, most, note, logarithmic=True)
    centres = glyphs.frame.to_world(glyphs.centres)
    ellipsoids = EllipsoidShape("tensors", centres, diagonal * glyphs.axes, diagonal * PLATE * glyphs.radius, (ratio,))
    figures = [("points", f"{len(tensors.points):,}"), ("directions determined", f"{tensors.determined.mean():.0%}")]
    write_shapes(path, title, [ellipsoids, _points(tensors, most, note)], figures, coloring=RATIO)


def _points(tensors: CurvatureTensors, most: float, note: str) -> PointShape:
    rows = thinned(len(tensors.points), MOST_POINTS)
    ratios = np.where(tensors.determined, tensors.stretching_ratio, np.nan)[rows]
    colorings = [Coloring(RATIO, ratios, 1.0, most, note, logarithmic=True)]
    _, highest = tensors.curvature_range
    for which, curvatures in enumerate(tensors.curvatures[rows].T, start=1):
        known = abs(curvatures[np.isfinite(curvatures)])
        high = min(highest, float(np.percentile(known, 98))) if len(known) else 0.0
        name = f"curvature {which}"
        told = f"Principal curvature {which}, in 1 / unit of the file" + (
            ": red convex, blue concave." if tensors.signed else "."
        )
        colorings.append(Coloring(name, curvatures, -high if tensors.signed else 0.0, high, told))
    return PointShape("points", tensors.points[rows], tensors.normals[rows], tuple(colorings))
