# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of the given normals are none: a constant where they are missing, or anything at all, at some points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.covariances import relative_covariances
from hdpea.geometry.thinning import rows_along
from hdpea.runtime.blocks import in_blocks
from hdpea.surface.plausibility import SAMPLES

Vectors = NDArray[np.float64]
Rows = NDArray[np.int64]

AROUND = 16
"""Nearest points that a direction is compared with."""

FLAT = 0.02
"""Most variance of these along the normal of their plane, relative to a random direction, that is clearly a plane.

At the rims of thin walls normals lie in the plane of all other points. Of 271 meshes, 1,000 points each, true normals
of two are refused with 0.03, and of `snowflake_tealight`, whose walls are a spacing thick, of 5,000 points as well."""

LEAST_ANGLE, NOISE = np.radians(55), 4.0
"""Least angle to the normal of a clear plane at which a direction may be none, and that in medians of these angles.

Where normals err by 20 degrees the median is 23, and none are refused: some are off by 60, but by noise."""

ALIKE, BESIDE = 0.8, 0.3
"""Least cosine between directions that are alike, and largest sine to a neighbour that lies in the plane across one."""

SUPPORTERS = 2
"""Fewest neighbours that are alike and in the plane across a direction that is borne out."""

LEAST_SHARE = 0.02
"""Share of directions that are clearly none from which on any are refused.

Of the same meshes, true normals of this one are refused of 1,000 and of 2,000 points, of none of 5,000 and 20,000. With
normals that err by 5 to 30 degrees or are turned over at random, and noise of the points of up to a spacing, none are
of 45 others, 2,000 and 20,000 points each. Where a fifth was replaced, of these 46 some are refused in four of ten
clouds of 2,000 points, seven of 5,000 and nearly nine of 20,000."""

OFTEN = 0.1
"""Share of the refused that have one value, and of that value that is refused, from which on all of it is.

A constant is a normal where the surface happens to face that way, and on the opposite side one of the wrong sign: with
these left, of bull with a fifth replaced in one region, 6.7 % of the mesh was wrong, and without them nothing is."""


def contrary_normals(points: Vectors, directions: Vectors) -> NDArray[np.bool_]:
    """Tell which directions (n,) lie along the surface that the points show rather than across it.

    That most are normals is up to ``are_normals``. A direction far from the normal of a clear plane that no others bear
    out is none. Near creases and on thin parts nothing is as clear: there, those are refused that none bear out beside
    refused ones, and what is beside these in turn. Where few are clear, none are refused.

    Parameters
    ----------
    points
        (n, 3), distinct.
    directions
        (n, 3) of length 1 and any sign, or 0 where there is none.
    """
    given, refused = np.flatnonzero(directions.any(axis=1)), np.zeros(len(points), dtype=bool)
    if not len(given) or len(points) <= AROUND:
        return refused
    sample = given[rows_along(len(given), SAMPLES)]
    near = _core.nearest_neighbors(points, np.ascontiguousarray(points[sample]), AROUND + 1)[:, 1:]
    angles = _angles(points, directions, sample, near)
    steepest = max(LEAST_ANGLE, NOISE * float(np.median(angles[angles >= 0]))) if (angles >= 0).any() else np.inf

    def without_support(rows: Rows, near: Rows) -> Rows:
        return rows[~_borne_out(points, directions, rows, near, refused)]

    if len(without_support(sample[angles > steepest], near[angles > steepest])) <= LEAST_SHARE * len(sample):
        return refused
    nearest = _core.nearest_neighbors(points, AROUND)
    steep = given[_angles(points, directions, given, nearest[given]) > steepest]
    refused[without_support(steep, nearest[steep])] = True
    changed = refused = _with_their_values(directions, refused)
    while changed.any():
        beside = np.flatnonzero(directions.any(axis=1) & ~refused & changed[nearest].any(axis=1))
        changed = np.zeros_like(refused)
        changed[without_support(beside, nearest[beside])] = True
        refused = refused | changed
    return refused


def _angles(points: Vectors, directions: Vectors, rows: Rows, near: Rows) -> Vectors:
    """Return the angles (m,) of the rows' directions to the normals of their neighbours' planes, -1 where not clear."""

    def angles(block: slice) -> Vectors:
        variances, axes = np.linalg.eigh(relative_covariances(points[near[block]]))
        cosines = abs(np.einsum("nc,nc->n", axes[:, :, 0], directions[rows[block]]))
        return np.where(variances[:, 0] < FLAT, np.arccos(np.minimum(cosines, 1)), -1)

    return in_blocks(angles, len(rows))


def _borne_out(
    points: Vectors, directions: Vectors, rows: Rows, near: Rows, refused: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Return which directions of the rows (m,) have neighbours that are alike, most of them in the plane across it.

    Alike with their sign: of what is no normal and lies across the surface by chance, half is on the wrong side.
    """

    def borne_out(block: slice) -> NDArray[np.bool_]:
        own, around = directions[rows[block]], near[block]
        ways = points[around] - points[rows[block], None]
        beside = abs(np.einsum("nkc,nc->nk", ways, own)) < BESIDE * np.linalg.norm(ways, axis=2)
        alike = np.einsum("nkc,nc->nk", directions[around], own) > ALIKE
        support = (alike & beside & ~refused[around]).sum(axis=1)
        return np.asarray((support >= SUPPORTERS) & (2 * support >= alike.sum(axis=1)))

    return in_blocks(borne_out, len(rows))


def _with_their_values(directions: Vectors, refused: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which directions (n,) are refused, or have a value that often is: it is no normal anywhere."""
    values = np.unique(directions, axis=0, return_inverse=True)[1].ravel()
    often = np.bincount(values, refused) > OFTEN * np.maximum(np.bincount(values), np.count_nonzero(refused))
    return np.asarray(refused | often[values])
