# SPDX-License-Identifier: GPL-3.0-or-later
"""Strays so many that they are each other's company: they fill a volume, more sparsely than a surface is sampled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.standing import Standing
from hdpea.geometry.covariances import covariances
from hdpea.geometry.thinning import rows_along
from hdpea.runtime.blocks import in_blocks

SAMPLES = 2_000
"""Points at which it is looked how far apart those of a surface are, and whether there are such strays."""

NEAREST = 24
"""Nearest points whose spread tells a volume from a surface, an edge and a thin part."""

FLAT, ROUND = 0.45, 0.5
"""Ratio of the least deviation of these to the middle one up to which they show a plane, and to the largest from which
on they fill a volume.

Of strays anywhere in a box half have 0.55 to 0.63 or more of the latter, of points of a surface without any one in a
hundred 0.47."""

LEAST_FLAT = 0.1
"""Share of points that show a plane without which nothing is known of how far apart a surface's are."""

REACH, FARTHER = 12, 1.3
"""Nearest point that must be so many times farther than most that show a plane have theirs."""

COMPANY, LEAST_COMPANY = 8, 6
"""Nearest points of which so many must fill a volume as well: corners do not."""

LEAST_SHARE = 0.05
"""Share of a cloud's points from which on they are strays. Fewer, the others tell."""

MOST_APART = 2.0
"""How far most of those that show a plane have the next of them, in their own distances to the 12th nearest.

Strays lie all around a surface: three of four of its points have 1.3 to 2 of some shapes, 2.6 at most. Where instead a
part is sampled so sparsely that its two sides are as near as its points, it is 2.1 to 30, of one mesh of 130 1.4."""

MOST = 0.75
"""How many are most."""


def scattered(standing: Standing) -> NDArray[np.int64]:
    """Return the rows of strays, of the points that are left, if a good part of them is.

    Where two of five points are strays, anywhere in a box around a model, their nearest are strays as well, and hardly
    more than twice as far as on its surface.
    """
    rows = standing.rows
    sample = rows[rows_along(len(rows), SAMPLES)]
    ratios, reached = _ratios(standing, sample), standing.reached(REACH)
    flat = sample[ratios[:, 0] < FLAT]
    if len(rows) <= NEAREST or len(flat) < LEAST_FLAT * len(sample):
        return rows[:0]
    far = FARTHER * np.median(reached[flat])
    if np.mean((ratios[:, 1] > ROUND) & (reached[sample] > far)) < LEAST_SHARE:
        return rows[:0]
    sparse, volume = rows[reached[rows] > far], np.zeros(len(standing.points), dtype=bool)
    volume[sparse] = in_blocks(lambda block: _ratios(standing, sparse[block])[:, 1] > ROUND, len(sparse))
    found = rows[volume[rows] & (volume[standing.nearest[rows, :COMPANY]].sum(axis=1) >= LEAST_COMPANY)]
    if len(found) < LEAST_SHARE * len(rows) or _apart(standing, found, flat) > MOST_APART * np.median(reached[found]):
        return rows[:0]
    return np.asarray(found)


def _apart(standing: Standing, strays: NDArray[np.int64], flat: NDArray[np.int64]) -> float:
    """Return how far most of the `flat` rows have the next of the `strays`."""
    found, places = (np.ascontiguousarray(standing.points[rows]) for rows in (strays, flat))
    nearest = _core.nearest_neighbors(found, places, 1)[:, 0]
    return float(np.quantile(np.linalg.norm(found[nearest] - places, axis=1), MOST))


def _ratios(standing: Standing, rows: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the ratios (m, 2) of the least deviation of the points nearest to each row to the middle and largest."""
    variances = np.linalg.eigvalsh(covariances(standing.points[standing.nearest[rows, :NEAREST]]))
    # What is distinct may still be too near for squares.
    variances = np.maximum(variances, np.finfo(np.float64).tiny)
    return np.asarray(np.sqrt(variances[:, :1] / variances[:, 1:]))
