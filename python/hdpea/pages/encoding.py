# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes as the numbers in a page: positions in 16 bits, colours in 8. decoding.js is the other side of this."""

from __future__ import annotations

from base64 import b64encode
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.pages.shapes import Coloring, EllipsoidShape, MeshShape, OwnColors, Shape, positions_of

Rows = NDArray[np.float64]

STEPS = 65_535
"""Of each side of the box: a 20th of a millimetre of three metres."""

SHADES, UNKNOWN = 254, 255
"""Of a ramp, and the byte of what is not known."""


class Box:
    """The box around all shapes of a page, and its frame: centred, the longest side 1."""

    def __init__(self, shapes: tuple[Shape, ...]) -> None:
        positions = [positions_of(each) for each in shapes]
        lowest = np.min([each.min(axis=0) for each in positions], axis=0)
        highest = np.max([each.max(axis=0) for each in positions], axis=0)
        self.centre = lowest / 2 + highest / 2
        self.size = float((highest / 2 - lowest / 2).max()) * 2 or 1.0
        self.extent = (highest / self.size - lowest / self.size).clip(min=1e-9)

    def in_frame(self, points: Rows) -> Rows:
        """Return points (n, 3) in the frame of the box."""
        return np.asarray(points / self.size - self.centre / self.size)

    def encoded(self, points: Rows) -> str:
        """Return points (n, 3) as text, in ``STEPS`` along each side."""
        shares = self.in_frame(points) / self.extent + 0.5
        return text_of(np.rint(STEPS * shares.clip(0, 1)).astype("<u2"))


def with_common_ranges(shapes: tuple[Shape, ...]) -> tuple[Shape, ...]:
    """Return the shapes with one range for all colourings of a name, so that colours side by side mean the same."""
    ramps = [each for shape in shapes for each in shape.colorings if isinstance(each, Coloring)]
    low = {name: min(each.low for each in ramps if each.name == name) for name in {each.name for each in ramps}}
    high = {name: max(each.high for each in ramps if each.name == name) for name in low}

    def widened(each: Coloring | OwnColors) -> Coloring | OwnColors:
        return replace(each, low=low[each.name], high=high[each.name]) if isinstance(each, Coloring) else each

    return tuple(replace(shape, colorings=tuple(map(widened, shape.colorings))) for shape in shapes)


def encoded_shape(shape: Shape, box: Box) -> dict[str, Any]:
    """Return a shape as JSON for the page."""
    colorings = [encoded_coloring(each) for each in shape.colorings]
    common = {"name": shape.name, "count": len(positions_of(shape)), "colorings": colorings}
    match shape:
        case MeshShape():
            wide = len(shape.vertices) > 2**16
            faces = text_of(shape.faces.astype("<u4" if wide else "<u2"))
            return common | {"kind": "mesh", "positions": box.encoded(shape.vertices), "wide": wide, "faces": faces}
        case EllipsoidShape():
            centres = text_of(box.in_frame(shape.centres).astype("<f4"))
            axes = text_of((shape.axes / box.size).astype("<f4"))
            return common | {"kind": "ellipsoids", "centres": centres, "axes": axes, "plate": shape.plate / box.size}
        case _:
            normals = text_of(np.rint(127 * shape.normals.clip(-1, 1)).astype("i1"))
            return common | {"kind": "points", "positions": box.encoded(shape.points), "normals": normals}


def encoded_coloring(coloring: Coloring | OwnColors) -> dict[str, Any]:
    """Return a colouring as JSON for the page."""
    if isinstance(coloring, OwnColors):
        return {"name": coloring.name, "kind": "colors", "values": text_of(coloring.values)}
    low, high, values = coloring.low, coloring.high, coloring.values
    middle = np.sqrt(low * high) if coloring.logarithmic else low / 2 + high / 2
    if coloring.logarithmic:
        low, high, values = np.log(low), np.log(high), np.log(np.where(values > 0, values, np.nan))
    known = np.isfinite(values)
    shares = (np.where(known, values, low) - low) / ((high - low) or 1.0)
    shades = np.where(known, np.rint(SHADES * shares.clip(0, 1)), UNKNOWN).astype(np.uint8)
    marks = [f"{each:.3g}" for each in (coloring.low, middle, coloring.high)]
    return {"name": coloring.name, "kind": "ramp", "values": text_of(shades), "marks": marks, "note": coloring.note}


def text_of(array: NDArray[Any]) -> str:
    """Return the bytes of an array, row by row, as text."""
    return b64encode(np.ascontiguousarray(array).tobytes()).decode("ascii")
