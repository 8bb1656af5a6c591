# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the signs of given normals are to be believed, or point both ways: at random, or patch by patch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

Vectors = NDArray[np.float64]

TRUSTED_CONSISTENCY = 0.9
"""Share of neighbours in agreement under which signs are not believed; random signs give 0.5."""

MOST_SEAMS, SEAMLESS = 0.95, 0.999
"""Shares of neighbours in agreement between which seams of patches are looked for.

With more that disagree, walls may be thinner than the points are apart, where neighbours turn one side over."""

FEWER_CONTRADICTIONS, LEAST_TURNED = 5.0, 0.05
"""How many times fewer neighbours must disagree where the sign is carried from one to the next, and which share of the
points that must turn, for signs to be wrong patch by patch.

Of the 251 training meshes, 5,000 points each, one whose normals are right is taken for patchy, and of those whose
normals all face along the positive axis that is nearest 62 of the 69 with so few seams."""

STEEPEST, PARALLEL = 0.5, 0.8
"""Largest sine of the angle between the surface and the way to a neighbour whose normal is parallel, by this cosine,
where a seam may run between the two: sheets that face the same way, one above the other, contradict each other and are
right."""


@dataclass(frozen=True)
class GivenSigns:
    """What is thought of the signs of given normals.

    Attributes
    ----------
    consistency
        Share of neighbours that agree on the side.
    patchy
        Whether those that do not lie along seams between patches that face opposite ways, which another choice of
        sides does without.
    """

    consistency: float
    patchy: bool

    @property
    def trusted(self) -> bool:
        """Whether they say which side is out."""
        return self.consistency >= TRUSTED_CONSISTENCY and not self.patchy


def given_signs(points: Vectors, given: Vectors, neighbors: NDArray[np.int64]) -> GivenSigns | None:
    """Judge the signs of normals; None if there are none.

    Normals that were fitted and never oriented, such as those of principal components, which all have a positive z or
    face along a positive axis, agree nearly everywhere: neighbours contradict each other along seams only. They are
    told by signs carried from neighbour to neighbour: where these turn whole patches over and have next to no seams,
    there need be none. Where things touch, and walls are thin, these have seams as well.

    Parameters
    ----------
    points
        (n, 3), distinct.
    given
        (n, 3) of length 1, or 0 where there is none.
    neighbors
        (n, k): nearest other points, -1 pads.
    """
    usable = given.any(axis=1)
    if not usable.any():
        return None
    consistency = _core.orientation_consistency(points, given, neighbors)
    if not MOST_SEAMS <= consistency < SEAMLESS:
        return GivenSigns(consistency, patchy=False)
    if not usable.all():
        points, given = np.ascontiguousarray(points[usable]), np.ascontiguousarray(given[usable])
        neighbors = _core.nearest_neighbors(points, neighbors.shape[1])
    beside = _beside(points, given, neighbors)
    contradicting = 1 - _core.orientation_consistency(points, given, beside)
    if contradicting <= 1 - SEAMLESS:
        return GivenSigns(consistency, patchy=False)
    carried = _core.orient_normals(points, given, neighbors)
    turned = float((np.einsum("nc,nc->n", carried, given) < 0).mean())
    seams = 1 - _core.orientation_consistency(points, carried, beside)
    fewer = FEWER_CONTRADICTIONS * seams < contradicting
    return GivenSigns(consistency, patchy=fewer and LEAST_TURNED < turned < 1 - LEAST_TURNED)


def _beside(points: Vectors, normals: Vectors, neighbors: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the neighbours (n, k) that lie beside a point on its surface, -1 in place of those above and below it."""
    ways = points[neighbors] - points[:, None]
    height = abs(np.einsum("nkc,nc->nk", ways, normals))
    parallel = abs(np.einsum("nkc,nc->nk", normals[neighbors], normals)) > PARALLEL
    stacked = parallel & (height > STEEPEST * np.linalg.norm(ways, axis=2))
    return np.where(stacked, -1, neighbors)
