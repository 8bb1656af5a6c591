# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and points as one HTML file, to be turned in any browser, offline."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.smooth_fans import CREASE
from hdpea.pages.encoding import Box, encoded_shape, with_common_ranges
from hdpea.pages.shapes import EllipsoidShape, MeshShape, OwnColors, PointShape, Shape
from hdpea.pictures.camera import choose_view, choose_view_of_points
from hdpea.pictures.colors import RAMP, UNDETERMINED
from hdpea.pictures.picture import BACK, DOTS, EDGES, FRONT
from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import check_output, replacing

PAGE_FORMATS = (".html", ".htm")

HERE = Path(__file__).parent

SCRIPTS = ("decoding", "drawing", "objects", "panel")
"""Which a page contains, in this order."""

Figures = Sequence[tuple[str, str]]
"""What is said about the shapes: names and values."""


def write_page(
    path: Path,
    title: str,
    shapes: Sequence[Shape],
    figures: Figures = (),
    *,
    coloring: str = "",
    beside: int | None = None,
    sight: NDArray[np.float64] | None = None,
    up: str | None = None,
) -> None:
    """Write a page on which shapes can be turned, coloured and compared, that needs nothing but a browser with WebGL.

    Parameters
    ----------
    path
        An HTML file, replaced only once the new one is complete.
    title
        Of the page.
    shapes
        One at least, all in the same coordinates; the first is shown.
    figures
        What is said about them.
    coloring
        Name of the colouring that is shown first; by default none. With the data's own colours, edges are hidden first.
    beside
        Index of the shape that is shown beside the first; by default none.
    sight
        (3,), from where the surface was seen, as ``mean_sight`` returns it.
    up
        The axis that is up, by its name; default: the one that the first mesh shows, or else the first shape.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    check_output(path, PAGE_FORMATS)
    shapes = with_common_ranges(tuple(shapes))
    box = Box(shapes)
    view = _view(next((each for each in shapes if isinstance(each, MeshShape)), shapes[0]), sight, up)
    axis = abs(view[1]).argmax()
    scene = {
        "shapes": [encoded_shape(each, box) for each in shapes],
        "origin": (-box.extent / 2).tolist(),
        "extent": box.extent.tolist(),
        "up": (np.sign(view[1, axis]) * np.eye(3)[axis]).tolist(),
        "eye": view[2].tolist(),
        "coloring": coloring,
        "edges": not _shows_own_colors(shapes[0], coloring),
        "crease": math.radians(CREASE),
        "beside": "" if beside is None else str(beside),
        "ramp": [_bytes(each) for each in RAMP],
        "unknown": _bytes(UNDETERMINED),
        "colors": {"front": FRONT, "back": BACK, "edges": EDGES, "dots": DOTS},
    }
    values = {
        "title": escape(title),
        "mark": mark_of("page"),
        "figures": "".join(f"<tr><td>{escape(name)}</td><td>{escape(value)}</td></tr>" for name, value in figures),
        # The only character that could end the script that the data are part of.
        "page": json.dumps(scene, separators=(",", ":")).replace("<", "\\u003c"),
        "three": (HERE / "three.min.js").read_text(encoding="utf-8"),
        **{name: (HERE / f"{name}.js").read_text(encoding="utf-8") for name in SCRIPTS},
    }
    with replacing(path) as partial:
        # The title may be the name of a file, which need not be text.
        partial.write_text(_filled(values), encoding="utf-8", errors="replace")


def _filled(values: dict[str, str]) -> str:
    """Return the template with each ``{{name}}`` replaced by its value, in which nothing is replaced."""
    first, *rest = (HERE / "page.html").read_text(encoding="utf-8").split("{{")
    named = (each.split("}}", 1) for each in rest)
    return first + "".join(values[name] + text for name, text in named)


def _shows_own_colors(shape: Shape, coloring: str) -> bool:
    return any(each.name == coloring and isinstance(each, OwnColors) for each in shape.colorings)


def _view(shape: Shape, sight: NDArray[np.float64] | None, up: str | None) -> NDArray[np.float64]:
    match shape:
        case MeshShape():
            return choose_view(shape.vertices, shape.faces, sight, up)
        case EllipsoidShape():
            outward = shape.axes[:, 2] / np.linalg.norm(shape.axes[:, 2], axis=1, keepdims=True)
            return choose_view_of_points(shape.centres, outward, sight, up)
        case PointShape():  # whose normals do not say which side is out
            return choose_view_of_points(shape.points, np.zeros_like(shape.points), sight, up)


def _bytes(color: tuple[float, float, float]) -> list[int]:
    return [round(255 * share) for share in color]
