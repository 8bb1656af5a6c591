# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a scene that were sampled far more densely than most of it, and do not continue it: small things in it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.linked import first_linked
from hdpea.geometry.thinning import rows_without
from hdpea.surface.surface import AREA_NEIGHBORS, areas_shown

Vectors = NDArray[np.float64]

DENSER = 4.0
"""How many times the spacing of a part must go into that of the scene, which is that of most of its area.

Spread by area, such a part has a sixteenth of the vertices that its points could show, or less."""

LINKED = 4.0
"""Farthest that neighbours lie apart that hang together, in spacings of the one that is denser."""

FEWEST = 500
"""Points of a part, and of what is left of the scene, at least: fewer would have some 60 vertices."""

BESIDE = 2.0
"""Farthest of the scene's points from a part that counts as beside it, in spacings of the scene."""

CONTINUING, ALIKE = 0.5, 0.5
"""Largest sine between such a point and the tangent plane of the part, and least cosine of their normals, where the
part continues the scene."""

MOST_CONTINUING = 0.25
"""Share of the points beside a part from which on it is a region of the scene's own surface, sampled more densely."""


def dense_parts(points: Vectors, directions: Vectors, neighbors: NDArray[np.int64]) -> tuple[NDArray[np.int64], ...]:
    """Return the rows of each part of points (n, 3) that was sampled far more densely than the scene; mostly none.

    Points hang together where they are neighbours and near each other by the spacing of either; so what lies in a scene
    four times as sparse does not hang together with it, even where they touch. A region of one surface that is denser
    than the rest stays with it.

    Parameters
    ----------
    directions
        (n, 3) of the normals, whose signs do not matter.
    neighbors
        (n, k >= 12) nearest points, nearest first.
    """
    if len(points) < 2 * FEWEST:
        return ()
    areas = areas_shown(points, neighbors)
    spacings = np.sqrt(areas)
    scene = _of_most_area(spacings, areas)
    if DENSER * np.quantile(spacings, FEWEST / 2 / len(points)) > scene:
        return ()
    labels = _linked(points, neighbors[:, :AREA_NEIGHBORS], spacings)
    names, counts = np.unique(labels, return_counts=True)
    found = [np.flatnonzero(labels == name) for name in names[counts >= FEWEST]]
    found = [rows for rows in found if DENSER * np.median(spacings[rows]) <= scene]
    found = [rows for rows in found if not _continues(points, directions, rows, BESIDE * scene)]
    return tuple(found) if len(points) - sum(map(len, found)) >= FEWEST else ()


def _of_most_area(values: Vectors, areas: Vectors) -> float:
    """Return the median of the values (n,) over the area."""
    order = np.argsort(values, kind="stable")
    below = np.cumsum(areas[order])
    return float(values[order[np.searchsorted(below, below[-1] / 2)]])


def _linked(points: Vectors, neighbors: NDArray[np.int64], spacings: Vectors) -> NDArray[np.int64]:
    """Return for each point (n,) the first of those that hang together with it, from neighbour to neighbour."""
    rows = np.repeat(np.arange(len(points)), neighbors.shape[1])
    others = neighbors.ravel()
    lengths = np.linalg.norm(points[others] - points[rows], axis=1)
    linked = lengths <= LINKED * np.minimum(spacings[rows], spacings[others])
    return first_linked(len(points), rows[linked], others[linked])


def _continues(points: Vectors, directions: Vectors, rows: NDArray[np.int64], reach: float) -> bool:
    """Return whether the part of these rows (m,) continues along its tangent planes into the points within reach."""
    least, most = points[rows].min(axis=0) - reach, points[rows].max(axis=0) + reach
    others = rows_without(len(points), rows)
    others = others[((points[others] >= least) & (points[others] <= most)).all(axis=1)]
    nearest = rows[_core.nearest_neighbors(points[rows], points[others], 1)[:, 0]]
    offsets = points[others] - points[nearest]
    lengths = np.linalg.norm(offsets, axis=1)
    beside = lengths <= reach
    along = abs(np.einsum("nc,nc->n", offsets, directions[nearest])) <= CONTINUING * lengths
    alike = abs(np.einsum("nc,nc->n", directions[others], directions[nearest])) >= ALIKE
    return bool(beside.any() and (along & alike)[beside].mean() > MOST_CONTINUING)
