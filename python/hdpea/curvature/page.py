# SPDX-License-Identifier: GPL-3.0-or-later
"""Curvature tensors as one HTML file that any browser shows offline, to rotate and zoom."""

from __future__ import annotations

import html
import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.curvature.glyphs import PLATE, UNDETERMINED, glyphs_of
from hdpea.curvature.tensors import CurvatureTensors
from hdpea.pictures.camera import choose_view_of_points
from hdpea.pictures.colors import RAMP
from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import check_output, replacing

PAGE_FORMATS = (".html", ".htm")

GLYPHS = 3_000
"""Most glyphs: all are drawn again with every movement of the mouse."""

TEMPLATE = Path(__file__).with_name("page.html")


def write_page(path: Path, tensors: CurvatureTensors, title: str = "curvature") -> None:
    """Write the ellipsoids of ``draw_curvature`` as a page that needs nothing but a browser.

    Ellipsoids in parallel projection are ellipses, which a canvas can draw: it needs no WebGL and no graphics card.

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
    check_output(path, PAGE_FORMATS)
    glyphs = glyphs_of(tensors, GLYPHS)
    view = choose_view_of_points(glyphs.frame.to_unit(tensors.points), tensors.normals)
    scene = {
        "centres": _rounded(glyphs.centres),
        "axes": _rounded(glyphs.axes.reshape(-1, 9)),
        "colors": glyphs.colors.tolist(),
        "plate": round(PLATE * glyphs.radius, 5),
        "view": _rounded(view),
    }
    determined = tensors.determined.mean()
    values = {
        "mark": mark_of("page"),
        "title": html.escape(title),
        "points": f"{len(tensors.points):,}",
        "determined": f"{determined:.0%}",
        "ramp": ", ".join(_css(color) for color in RAMP),
        "undetermined": _css(UNDETERMINED),
        "most": f"{glyphs.most:.2g}",
        "middle": f"{glyphs.most**0.5:.2g}",
        # The only character that could end the script that the data are part of.
        "scene": json.dumps(scene, separators=(",", ":")).replace("<", "\\u003c"),
    }
    content = TEMPLATE.read_text(encoding="utf-8")
    for name, value in values.items():
        content = content.replace(f"{{{{{name}}}}}", value)
    with replacing(path) as partial:
        # The title may be the name of a file, which need not be text.
        partial.write_text(content, encoding="utf-8", errors="replace")


def _rounded(rows: NDArray[np.float64]) -> list[list[float]]:
    rounded: list[list[float]] = rows.round(5).tolist()
    return rounded


def _css(color: tuple[float, float, float]) -> str:
    return f"rgb({', '.join(f'{255 * share:.0f}' for share in color)})"
