# SPDX-License-Identifier: GPL-3.0-or-later
"""What a page can show: meshes, points, ellipsoids, each in several colourings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Rows = NDArray[np.float64]


@dataclass(frozen=True)
class Coloring:
    """Numbers as colours of a ramp, from blue to red; grey where they are not finite.

    Attributes
    ----------
    name
        By which it is chosen; shapes side by side are coloured by that of the same name.
    values
        (n,) float64, one for each vertex, point or ellipsoid.
    low, high
        Where the ramp begins and ends.
    note
        What the numbers are, in a sentence, with their unit.
    logarithmic
        Whether equal ratios are equally far along the ramp; then `low` > 0.
    """

    name: str
    values: Rows
    low: float
    high: float
    note: str
    logarithmic: bool = False


@dataclass(frozen=True)
class OwnColors:
    """Colours (n, 3) uint8 as the data have them."""

    name: str
    values: NDArray[np.uint8]


@dataclass(frozen=True)
class MeshShape:
    """A triangle mesh: vertices (v, 3), faces (f, 3), in the coordinates that all shapes of a page share."""

    name: str
    vertices: Rows
    faces: NDArray[np.int64]
    colorings: tuple[Coloring | OwnColors, ...] = ()


@dataclass(frozen=True)
class PointShape:
    """Points (n, 3), shaded by their normals (n, 3), of either sign."""

    name: str
    points: Rows
    normals: Rows
    colorings: tuple[Coloring | OwnColors, ...] = ()


@dataclass(frozen=True)
class EllipsoidShape:
    """Ellipsoids on a surface: centres (m, 3), half axes (m, 3, 3) as rows, the third along the normal.

    `plate` is the radius of the disk below each, that hides what lies behind the surface.
    """

    name: str
    centres: Rows
    axes: Rows
    plate: float
    colorings: tuple[Coloring | OwnColors, ...]


Shape = MeshShape | PointShape | EllipsoidShape


def positions_of(shape: Shape) -> Rows:
    """Return the positions (n, 3) of vertices, points or centres."""
    match shape:
        case MeshShape():
            return shape.vertices
        case PointShape():
            return shape.points
        case EllipsoidShape():
            return shape.centres
