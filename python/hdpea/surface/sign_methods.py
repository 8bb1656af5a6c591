# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods that find the signs of normals whose directions are known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.covariances import relative_covariances
from hdpea.runtime.blocks import in_blocks
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.contrary_normals import FLAT
from hdpea.surface.signs import SignEvidence, Vectors, cosines, turned
from hdpea.surface.single_view import GRAZING, View

AGREEING_COSINE = 0.5
"""Least |cosine| with the winding number's normal at which a direction counts as the same normal: 60 degrees."""

DEVIATIONS_WIDE = 1.6
"""Smoothing width of the winding number for each standard deviation of the noise.

A smaller width resolves single points, and beside holes half of a thick shell of noise turns inwards (boot, noise of
0.5 % of the diagonal); a larger one merges the two sides of a wall (goblet_top, as much noise, from 2.0 on)."""

MOST_OF_WALLS = 0.15
"""Largest deviation, in spacings, that counts for the width where it is not noise: walls must keep two sides."""


WIDE, MOST_OFF = 0.3, 0.01
"""Least variance of neighbours across a line, as ``FLAT``, with which they show a plane; and the share of the estimates
in clear planes that may be far from the winding number's normals, where these mean anything.

Of flat open sheets of 300 to 10,000 points 0.02 to 1.0 are, of ones with hills 0.006 to 0.08; of a ball on a floor
0.003, and of nine closed models none where most planes are clear."""

MANY = 0.25
"""Share of the neighbours of a point below others that are so, too, where it is of an underside: there half are."""

MOST_LEFT = 0.025
"""How often neighbours may disagree after they have agreed on signs.

On the two sides of a wall thinner than half a spacing, which pass for one, they do in 3 of 100 cases, through noise as
wide as points are apart in 4 and more; of 108 scans of 52 meshes without noise in 2 at most."""


def by_file(points: Vectors, directions: Vectors, evidence: SignEvidence) -> Vectors:
    """Take the signs of the given normals, and where there is none, that of the nearest point that has one."""
    signed = turned(directions, evidence.given)
    usable = np.asarray(evidence.given.any(axis=1))
    if usable.all():
        return signed
    oriented = by_neighbors(points, directions, evidence)
    kept = cosines(oriented, signed)[usable] >= 0
    nearest_usable = _core.nearest_neighbors(points[usable], points[~usable], 1)[:, 0]
    signed[~usable] = np.where(kept[nearest_usable], 1, -1)[:, None] * oriented[~usable]
    return signed


def by_view(points: Vectors, directions: Vectors, evidence: SignEvidence, view: View) -> Vectors:
    """Turn normals to what saw the points; those seen at a grazing angle, where noise decides, follow the others.

    So do those that lie below others, of clouds that nothing but the points says to be seen from above: undersides,
    which touch what lies below them.
    """
    signed = turned(directions, view.towards)
    known = np.asarray(cosines(signed, view.towards) > GRAZING)
    if view.below is not None:
        known &= ~_near_undersides(view.below, evidence.neighbors)
    return signed if known.all() else _core.orient_normals(points, signed, evidence.neighbors, known)


def _near_undersides(below: NDArray[np.bool_], neighbors: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which points (n,) are, or have neighbours, among those `below` others, if many around these are.

    Noise lifts single points; and some of an underside have by chance none above them.
    """
    beside = neighbors >= 0
    of_many = below & ((below[neighbors] & beside).sum(axis=1) >= MANY * beside.sum(axis=1))
    return np.asarray(of_many | (of_many[neighbors] & beside).any(axis=1))


def by_neighbors(points: Vectors, directions: Vectors, evidence: SignEvidence) -> Vectors:
    """Carry the sign from neighbour to neighbour, from part to part as most edges between them say."""
    return _core.orient_normals(points, directions, evidence.neighbors)


def _right_after_all(
    points: Vectors, directions: Vectors, neighbors: NDArray[np.int64], agreeing: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Return which estimates (n,) are right though the winding number's normals do not agree: on flat open sheets."""

    def clear(rows: slice) -> NDArray[np.bool_]:
        variances, axes = np.linalg.eigh(relative_covariances(points[neighbors[rows]]))
        across = abs(cosines(axes[:, :, 0], directions[rows])) > AGREEING_COSINE
        return np.asarray(across & (variances[:, 0] < FLAT) & (variances[:, 1] > WIDE))

    none = np.zeros(len(points), dtype=bool)
    # So few can be no such share of planes that are half of all.
    if 2 * np.count_nonzero(~agreeing) <= MOST_OFF * len(points):
        return none
    planar = in_blocks(clear, len(points))
    off = planar & ~agreeing
    sheet = 2 * np.count_nonzero(planar) > len(points) and np.count_nonzero(off) > MOST_OFF * np.count_nonzero(planar)
    return off if sheet else none


def by_winding_number(
    points: Vectors,
    directions: Vectors,
    evidence: SignEvidence,
    progress: PhaseCallback | None,
) -> Vectors:
    """Take the signs of the winding number's normals; estimates far from these are replaced by them.

    Beside large holes of the cloud these are wrong about half a face, and of a part of a room about any: so they only
    vote, and neighbours agree. Of 108 scans of 52 meshes from two to eight places without sensors, 1.5 % of the points
    are on the wrong side then, 6.8 % by the winding number alone. Through noise neighbours agree with less.
    """
    options, roughness = _core.WnncOptions(), evidence.roughness
    noise = roughness.deviation if roughness.like_noise else min(roughness.deviation, MOST_OF_WALLS)
    options.spacings_wide += DEVIATIONS_WIDE * noise
    winding = _core.wnnc_normals(points, options, progress)
    agreeing = abs(cosines(directions, winding)) >= AGREEING_COSINE
    signed = turned(directions, winding)
    # An estimate far off was fitted across an edge or a thin wall, which the winding number tells apart.
    replaced = evidence.estimated & ~agreeing & ~_right_after_all(points, directions, evidence.neighbors, agreeing)
    signed[replaced] = winding[replaced]
    agreed = _core.agree_on_signs(points, signed, evidence.neighbors)
    left = 1 - _core.orientation_consistency(points, agreed, evidence.neighbors)
    return agreed if left < MOST_LEFT else signed
