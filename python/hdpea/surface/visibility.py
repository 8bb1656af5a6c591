# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether sensors can have seen the points that they are said to have seen, or other points lie between."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.thinning import rows_along
from hdpea.surface.single_view import spacings_around, towards_of

Vectors = NDArray[np.float64]

LINES, THINNED = 500, 20_000
"""Lines of sight that are followed, and the most points that may lie on them."""

CLEAR = 0.5
"""Least cosine between normal and line of sight at which it soon leaves the surface that it starts on."""

START, BETWEEN = 4.0, 0.6
"""From how many spacings on points are looked for, which layers of scans are not apart, and how near a line one lies
between: a line through a surface has a point of it as near.

There a spacing is the median at most. A leaf of few points would block a line that passes far from it, as the nearest
points that its spacing is measured by are those of other leaves; right sensors before a hedge came to 0.4 to 0.55."""

STEPS = 200
"""Most steps along a line."""

MOST_HIDDEN = 0.25
"""Share of the lines with points on them from which on it is doubtful that sensors were there.

Of ten scans of rooms, streets, desks and terrain, by rays, it is 2 % at most, of hedges and tree tops, through which
sensors do see, 17 to 34 %. Of complete models whose file names one sensor for all points, those of another frame, or
each the sensor of another, it is 28 to 68 %."""


def share_hidden(points: Vectors, directions: Vectors, sensors: Vectors) -> float:
    """Return the share of lines of sight on which other points lie.

    Each line is followed from its point (n, 3) towards its sensor (n, 3), by steps as long as no point is near (Hart,
    "Sphere tracing", 1996). The signs of the `directions` (n, 3) of normals do not matter.
    """
    thinned = np.ascontiguousarray(points[rows_along(len(points), THINNED)])
    spacings = spacings_around(thinned, np.arange(len(thinned)))
    rows = rows_along(len(points), LINES)
    rows = rows[abs(np.einsum("nc,nc->n", towards_of(points[rows], sensors[rows]), directions[rows])) > CLEAR]
    if not len(rows):
        return 0.0
    starts, lines = points[rows], towards_of(points[rows], sensors[rows])
    with np.errstate(over="ignore"):  # as far as the cloud is wide will do
        ends = np.minimum(np.linalg.norm(sensors[rows] - starts, axis=1), np.linalg.norm(np.ptp(thinned, axis=0)))
    along = START * spacings[_core.nearest_neighbors(thinned, np.ascontiguousarray(starts), 1)[:, 0]]
    between = BETWEEN * np.minimum(spacings, np.median(spacings))
    hidden, open_lines = np.zeros(len(rows), dtype=bool), np.arange(len(rows))
    for _ in range(STEPS):
        open_lines = open_lines[~hidden[open_lines] & (along[open_lines] < ends[open_lines])]
        if not len(open_lines):
            break
        places = np.ascontiguousarray(starts[open_lines] + along[open_lines, None] * lines[open_lines])
        nearest = _core.nearest_neighbors(thinned, places, 1)[:, 0]
        distances, wide = np.linalg.norm(thinned[nearest] - places, axis=1), between[nearest]
        hidden[open_lines] = distances < wide
        along[open_lines] += np.maximum(distances - wide / 2, wide / 2)
    return float(hidden.mean())
