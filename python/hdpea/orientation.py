# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of the surface is out: the ways of finding the signs of normals whose directions are known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import UnreadableInput, UsageError
from hdpea.options import NormalOptions

Vectors = NDArray[np.float64]

AGREEING_COSINE = 0.5
"""Least |cosine| with the winding number's normal at which a direction is taken for the same normal: 60 degrees."""

LEAST_AGREEMENT = 0.8
"""Share of directions so near to the winding number's, below which that says nothing: 0.9 and more on what has an
inside, 0.3 where it has not, as on a plane."""


def require_signs(given: Vectors, sensors: Vectors | None, options: NormalOptions) -> None:
    """Refuse to orient by what is not there.

    Raises
    ------
    UnreadableInput
        If the file is to say the signs, or the sensors' positions, and does not.
    UsageError
        If there is no viewpoint to orient towards.
    """
    if options.orient == "file" and not given.any():
        raise UnreadableInput("There are no usable normals whose orientation to keep.", "Use --orient auto.")
    if options.orient == "viewpoint" and options.viewpoint is None:
        if sensors is None:
            raise UsageError(
                "There is no viewpoint to turn the normals to.",
                "Give --viewpoint X,Y,Z, or properties sensor_x, sensor_y and sensor_z in the file.",
            )
        if not np.isfinite(sensors).all():
            raise UnreadableInput("Not every point's sensor position is finite.", "Give one --viewpoint X,Y,Z.")


def by_file(points: Vectors, directions: Vectors, given: Vectors, neighbors: NDArray[np.int64]) -> Vectors:
    """Turn directions (n, 3) as the `given` normals have it, and where these are 0, as the nearest other has it."""
    signed = turned(directions, given)
    usable = np.asarray(given.any(axis=1))
    if usable.all():
        return signed
    oriented = by_spanning_tree(points, directions, neighbors)
    kept = cosines(oriented, signed)[usable] >= 0
    nearest_usable = _core.nearest_neighbors(points[usable], points[~usable], 1)[:, 0]
    signed[~usable] = np.where(kept[nearest_usable], 1, -1)[:, None] * oriented[~usable]
    return signed


def by_spanning_tree(points: Vectors, directions: Vectors, neighbors: NDArray[np.int64]) -> Vectors:
    """Hand on the side from neighbour to neighbour, the surest first."""
    return _core.orient_normals(points, directions, neighbors)


def by_winding_number(
    points: Vectors,
    directions: Vectors,
    estimated: NDArray[np.bool_],
    neighbors: NDArray[np.int64],
    progress: Callable[[float], bool] | None = None,
) -> tuple[Vectors, float]:
    """Turn directions (n, 3) as the winding number has it; those `estimated` far off it are replaced by its own.

    Where the cloud has large holes, the winding number may be wrong about the half of a face: so faces vote.

    Returns also the share of directions that agree with the winding number's.
    """
    winding = _core.wnnc_normals(points, progress=progress)
    agreeing = abs(cosines(directions, winding)) >= AGREEING_COSINE
    signed = turned(directions, winding)
    # Estimated far off, by neighbours of another sheet or another face: where this is so, the other is right.
    replaced = estimated & ~agreeing
    signed[replaced] = winding[replaced]
    return _core.agree_on_signs(points, signed, neighbors), float(agreeing.mean())


def turned(directions: Vectors, towards: Vectors) -> Vectors:
    """Return the directions (n, 3), those flipped that point away from the vectors `towards` (n, 3)."""
    return np.where(cosines(directions, towards) < 0, -1, 1)[:, None] * directions


def cosines(a: Vectors, b: Vectors) -> Vectors:
    """Return the scalar products of the rows of two arrays (n, 3)."""
    return np.asarray(np.einsum("nc,nc->n", a, b))
