# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that the front end finds out about a cloud."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.frontend.evenness import NEIGHBORS, Sampling, sampling_of
from hdpea.frontend.heaps import in_heaps
from hdpea.frontend.strays import find_strays
from hdpea.geometry.spatial_order import spatial_order

FEWEST_POINTS = 100
"""Fewer are taken as they are: nothing can be said of how they are spread."""

NEARLY_ALL, OUT_OF_PROPORTION = 0.95, 1e4
"""Share of the points that lie within some distance of the middle, and how many times as far others are strays.

They keep each other company, as positions without a fix do; but no surface is seen at both scales."""


@dataclass(frozen=True)
class Classified:
    """What each point of a cloud is.

    Attributes
    ----------
    strays
        (n,) bool: points that lie on no surface.
    in_heaps
        (n,) bool: strays that keep company as close as the other points do, and may be surface after all.
    kept
        (n,) bool: points that show the surface as evenly as it was sampled: no strays, and of those that crowd on scan
        lines only as many as are needed.
    spacing
        (n,) float64: how far apart the surface is sampled there, in the sparser direction; 0 where not known.
    on_lines
        Share of the points that lie on scan lines; 0 for an even cloud.
    """

    strays: NDArray[np.bool_]
    in_heaps: NDArray[np.bool_]
    kept: NDArray[np.bool_]
    stands_for: NDArray[np.int64]
    spacing: NDArray[np.float64]
    on_lines: float

    @property
    def shown(self) -> int:
        """How many points' worth of detail there is: twice those kept, if there are more."""
        return min(int((~self.strays).sum()), 2 * int(self.kept.sum()))


def classify(points: ArrayLike) -> Classified:
    """Tell of distinct, finite points (n, 3) which are strays, which show the surface, and how densely.

    Clouds of fewer than 100 points are taken as they are.

    Examples
    --------
    >>> import numpy as np
    >>> flat = np.random.default_rng(0).random((2000, 3)) * [1, 1, 0]
    >>> np.flatnonzero(classify(np.vstack([flat, [[0.5, 0.5, 1.0]]])).strays)
    array([2000])
    """
    rows = np.ascontiguousarray(points, dtype=np.float64)
    if len(rows) < FEWEST_POINTS:
        nothing = np.zeros(len(rows), dtype=bool)
        return Classified(nothing, nothing, ~nothing, np.arange(len(rows)), np.zeros(len(rows)), 0.0)
    # Differences of large coordinates lose digits, so the origin comes to the cloud first.
    centered = rows - np.median(rows, axis=0)
    order = spatial_order(centered)
    centered = centered[order]
    with core_errors_translated():
        nearest = _core.nearest_neighbors(centered, NEIGHBORS)
        sampling = sampling_of(centered, nearest)
        strays = _strays_of(centered, nearest, sampling) | _out_of_proportion(centered)
    heaped = in_heaps(centered, nearest, strays)
    given = np.empty_like(order)
    given[order] = np.arange(len(order))
    kept = sampling.kept & ~strays
    stands_for = order[sampling.stands_for]
    return Classified(
        strays[given], heaped[given], kept[given], stands_for[given], sampling.spacing[given], sampling.on_lines
    )


def _out_of_proportion(centered: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return which points (n, 3), about their middle, are too far away to be of the same scan, (n,) bool."""
    distances = abs(centered).max(axis=1)  # squares may be no doubles
    return np.asarray(distances > OUT_OF_PROPORTION * np.quantile(distances, NEARLY_ALL))


def _strays_of(points: NDArray[np.float64], nearest: NDArray[np.int64], sampling: Sampling) -> NDArray[np.bool_]:
    """Return the strays (n,) among points (n, 3); what was left out on lines is what the nearest kept one is."""
    on_lines = sampling.on_lines > 0
    if sampling.kept.all():
        return find_strays(points, nearest, on_lines)
    # On lines nearly everything lies apart from the rest, until they are thinned.
    kept = np.ascontiguousarray(points[sampling.kept])
    strays = np.zeros(len(points), dtype=bool)
    strays[sampling.kept] = find_strays(kept, _core.nearest_neighbors(kept, NEIGHBORS), on_lines)
    return strays[sampling.stands_for]
