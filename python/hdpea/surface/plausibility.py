# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether directions that came with points are normals at all: colours, labels and lines of sight may pass for some."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.covariances import relative_covariances
from hdpea.geometry.thinning import rows_along

SAMPLES = 2_000
"""Points at which it is looked."""

SCALES = (6, 16, 48, 150)
"""Nearest points along which they are compared: few where the surface is thin, many where it is rough."""

MOST_VARIANCE = 0.8
"""Variance along the directions, relative to that along random ones, from which they are no normals.

Of 50 training meshes and the 20 of validation, 1,000 to 60,000 points with noise of 0 to 1 % of the diagonal: true
normals have 0.13 in the median and 0.71 at most (a lattice of 1,000 points), random directions 0.95 or more, unit
vectors by label 0.94, lines of sight 0.99 in the median. These have less where all is flat and faces the sensor, and do
no harm there."""

MOST_IN_COMMON = 0.45
"""The same of what neighbours have in common, from which they are no normals either.

Directions away from a centre agree with their neighbours and have less variance than random ones: 0.63 to 0.71 on tori,
0.51 or more on 19 of the 20 meshes of validation. True normals of these that have less than `MOST_VARIANCE`, of 300 to
20,000 points, have 0.37 at most: with noise as wide as the spacing, or with errors of 20 degrees and 30 % at random."""

AGREEING = 6
"""Nearest points, the point itself among them, whose directions are compared."""


def are_normals(points: NDArray[np.float64], directions: NDArray[np.float64]) -> bool:
    """Tell whether directions lie across the surface that the points show.

    Along a normal the nearest points vary least, along a random direction as much as on average. Their variance is
    compared at several scales, of which the one that speaks most for the directions counts. Noise of the directions
    adds to it, and is told by how little neighbours agree: normals may have more of that than of a common error, such
    as lines from one place have.

    Parameters
    ----------
    points
        (n, 3), distinct.
    directions
        (n, 3) of length 1 and any sign, or 0 where there is none.
    """
    rows = np.flatnonzero(directions.any(axis=1))
    scales = [count for count in SCALES if count < len(points)]
    if not len(rows) or not scales:
        return True
    rows = rows[rows_along(len(rows), SAMPLES)]
    nearest = _core.nearest_neighbors(points, np.ascontiguousarray(points[rows]), scales[-1])
    variance = min(_variance_along(directions[rows], points[nearest[:, :count]]) for count in scales)
    by_noise = _variance_by_noise(directions[rows], directions[nearest[:, 1:AGREEING]])
    return variance < MOST_VARIANCE and variance - by_noise < MOST_IN_COMMON


def _variance_by_noise(directions: NDArray[np.float64], around: NDArray[np.float64]) -> float:
    """Return the variance along directions (m, 3) that is due to errors of each by itself, as `_variance_along` has it.

    Those `around` (m, k, 3) have the same errors, so that the squared sine between two is twice that of one, of which
    the variance on a plane is one and a half. Curvature and creases add to it, and may: this makes for leniency.
    """
    compared = np.count_nonzero(around.any(axis=2))
    squared_sines = 1 - np.square(np.einsum("nkc,nc->nk", around, directions)).sum() / max(compared, 1)
    return float(0.75 * squared_sines)


def _variance_along(directions: NDArray[np.float64], around: NDArray[np.float64]) -> float:
    """Return the variance of points (m, k, 3) along directions (m, 3): 0 is the least there is, 1 that at random."""
    # Neighbourhoods count alike, whatever their size; those of points that are equal in the unit frame, not at all.
    spread = relative_covariances(around)
    least = np.linalg.eigvalsh(spread)[:, 0]
    along = np.einsum("nc,ncd,nd->n", directions, spread, directions)
    random = np.trace(spread, axis1=1, axis2=2) / 3
    excess = float((random - least).sum())
    return float((along - least).sum()) / excess if excess > 0 else 0.0
