# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of the given normals are none: a constant where they are missing, or anything at all, at some points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.thinning import rows_along
from hdpea.runtime.blocks import in_blocks

Vectors = NDArray[np.float64]
Rows = NDArray[np.int64]

AROUND = 16
"""Nearest points that a direction is compared with."""

SAMPLES = 2_000
"""Points at which it is looked whether there are any: of a sphere of a million, that takes 0.3 s."""

LEAST_ANGLE, NOISE = np.radians(55), 4.0
"""Least angle to the normal of the neighbours' plane at which a direction may be none, and that in its medians.

Where normals err by 20 degrees the median is 23, and none are refused: some are off by 60, but by noise. It is 15 or
less for true normals of 40 of 45 meshes, 20,000 points each; on the other five, of rods and walls a spacing thick,
planes are no measure, and hardly anything is refused."""

FLAT = 0.03
"""Most variance of the points along the normal of their plane, relative to a random direction, that is clearly a plane.

At the rims of thin walls normals lie in the plane of all other points. Of 5,000 points of `snowflake_tealight`, whose
walls are a spacing thick, 18 % seem to be clearly none with 0.05, 6 % with 0.03; of bull with a fifth of the normals
replaced, 20,000 points, 5.7 and 4.8 %."""

BOTH_SIDES, RISE = 3, 0.35
"""Fewest neighbours on either side of a direction that is none, and the least sine at which they are on one.

All neighbours of a crease or of the rim of a sheet are on one side of their normals, or beside them."""

ALIKE, BESIDE, OFF = 0.8, 0.3, 0.5
"""Least cosine between directions that are alike, the largest sine to a neighbour that lies in the plane across one,
and the least to one that does not.

Normals of a narrow face are alike, and its points lie in their plane. Where a constant is given in place of normals,
more of the points lie off the plane than in it."""

LEAST_SHARE, LEAST_OF_STEEP = 0.015, 0.25
"""Shares that are clearly none, of all and of those steep to their neighbours' plane, from which on any are refused.

Of the 251 training meshes and the 20 of validation, none of the true normals are refused of 5,000 and of 20,000 points,
and on one mesh each of 1,000 and of 2,000. With normals that err by 5 to 30 degrees, are smoothed or turned over at
random, and with noise of the points of up to a spacing, none are of 45 meshes, 20,000 points each. Where a fifth was
replaced, on five meshes, 2.5 to 14 % of all are clearly none, and 0.25 to 0.72 of the steep ones."""

SAME_VALUE, OFTEN = 0.01, 0.1
"""Width of a value, and the share of the refused that have it, and of it that is refused, from which on all of it is.

A constant is a normal where the surface happens to face that way, and on the opposite side one of the wrong sign: with
these left, of bull with a fifth replaced in one region, 6.7 % of the mesh was wrong, and without them nothing is."""

SUPPORTERS = 2
"""Fewest neighbours that are alike and in the plane across a direction with which it is kept beside refused ones."""

ROUNDS = 8
"""How often those beside refused ones are looked at, which spreads to where no plane is clear.

Of 5,000 random directions in the crown of `lewis_queen`, 202 that are far off are left after two rounds, none after
five; of as many at random points of boot 1,388 after two and 476 after eight, with 2 and 7 % of the
others refused."""


def contrary_normals(points: Vectors, directions: Vectors) -> NDArray[np.bool_]:
    """Tell which directions (n,) lie along the surface that the points show rather than across it.

    That most are normals is up to ``are_normals``. Where neighbours lie in a plane, on both sides of a direction, and
    none around that is alike bears it out, it is none. Near creases and on thin parts nothing is as clear: others are
    refused only beside these or with their value, and none at all where these are few, or much of the cloud is thin.

    Parameters
    ----------
    points
        (n, 3), distinct.
    directions
        (n, 3) of length 1 and any sign, or 0 where there is none.
    """
    given = np.flatnonzero(directions.any(axis=1))
    if not len(given) or len(points) <= AROUND:
        return np.zeros(len(points), dtype=bool)
    rows = given[rows_along(len(given), SAMPLES)]
    near = _core.nearest_neighbors(points, np.ascontiguousarray(points[rows]), AROUND + 1)[:, 1:]
    steepest = _most_variance(points, directions, rows, near)
    variance, none = _clearly_none(points, directions, rows, near, steepest)
    least = max(LEAST_SHARE * len(rows), LEAST_OF_STEEP * np.count_nonzero(variance > steepest))
    if np.count_nonzero(none) <= least:
        return np.zeros(len(points), dtype=bool)
    return _refused(points, directions, steepest)


def _refused(points: Vectors, directions: Vectors, steepest: float) -> NDArray[np.bool_]:
    """Return which directions (n,) of a cloud are refused where some are: see ``contrary_normals``."""
    nearest, given = _core.nearest_neighbors(points, AROUND), directions.any(axis=1)
    _, refused = _clearly_none(points, directions, np.arange(len(points)), nearest, steepest)
    refused |= _of_refused_values(directions, refused)
    for _ in range(ROUNDS):
        rows = np.flatnonzero(given & ~refused & refused[nearest].any(axis=1))
        refused[rows] = _without_support(points, directions, rows, nearest[rows], refused)
    # Where most are none, the others are right by chance, and their signs are not.
    most = 2 * np.count_nonzero(refused[nearest], axis=1) > AROUND
    return np.asarray(refused | (most & given))


def _most_variance(points: Vectors, directions: Vectors, rows: Rows, near: Rows) -> float:
    """Return the variance along a direction that normals as noisy as those of the rows (m,) do not exceed."""
    axes = np.linalg.eigh(_scatter(points[near]))[1][:, :, 0]
    cosines = abs(np.einsum("nc,nc->n", axes, directions[rows]))
    angle = max(LEAST_ANGLE, NOISE * float(np.median(np.arccos(np.minimum(cosines, 1)))))
    # In a plane it is one and a half squared sines of the angle to the normal.
    return float(1.5 * np.sin(angle) ** 2) if angle < np.pi / 2 else np.inf


def _scatter(around: Vectors) -> Vectors:
    """Return the covariances (m, 3, 3) of points (m, k, 3), relative to the variance along a random direction."""
    offsets = around - around.mean(axis=1, keepdims=True)
    scatter = offsets.swapaxes(1, 2) @ offsets
    total = np.trace(scatter, axis1=1, axis2=2)
    return np.asarray(3 * scatter / np.where(total > 0, total, 1)[:, None, None])


def _clearly_none(
    points: Vectors, directions: Vectors, rows: Rows, near: Rows, steepest: float
) -> tuple[Vectors, NDArray[np.bool_]]:
    """Return the variance along the directions of the rows (m,), and which lie in a clear plane with no support."""

    def along(block: slice) -> Vectors:
        own = directions[rows[block]]
        return np.asarray(np.einsum("nc,ncd,nd->n", own, _scatter(points[near[block]]), own))

    def clear(block: slice) -> NDArray[np.bool_]:
        around = near[steep[block]]
        rises, cosines = _compared(points, directions, rows[steep[block]], around)
        alike = abs(cosines) > ALIKE
        flat = np.linalg.eigvalsh(_scatter(points[around]))[:, 0] < FLAT
        sides = np.minimum((rises > RISE).sum(axis=1), (rises < -RISE).sum(axis=1))
        beside, off = (alike & (abs(rises) < BESIDE)).sum(axis=1), (alike & (abs(rises) > OFF)).sum(axis=1)
        return np.asarray(flat & (sides >= BOTH_SIDES) & ((beside <= off) | (beside < SUPPORTERS)))

    variance, none = in_blocks(along, len(rows)), np.zeros(len(rows), dtype=bool)
    steep = np.flatnonzero(variance > steepest)
    none[steep] = in_blocks(clear, len(steep))
    return variance, none


def _of_refused_values(directions: Vectors, refused: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which directions (n,) have a value that many of the refused ones have: it is no normal anywhere."""
    cells = np.unique(np.round(directions / SAME_VALUE).astype(np.int64), axis=0, return_inverse=True)[1].ravel()
    of_refused, of_all = np.bincount(cells[refused], minlength=cells.max() + 1), np.bincount(cells)
    often = (of_refused > OFTEN * np.count_nonzero(refused)) & (of_refused > OFTEN * of_all)
    return np.asarray(often[cells])


def _without_support(
    points: Vectors, directions: Vectors, rows: Rows, near: Rows, refused: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Return which directions of the rows (m,) are like those of more refused neighbours than such in their plane."""

    def lonely(block: slice) -> NDArray[np.bool_]:
        rises, cosines = _compared(points, directions, rows[block], near[block])
        # With its sign: of what is no normal and lies across the surface by chance, half is on the wrong side.
        alike = cosines > ALIKE
        others = refused[near[block]]
        support = (alike & ~others & (abs(rises) < BESIDE)).sum(axis=1)
        return np.asarray((support < SUPPORTERS) | (support < (alike & others).sum(axis=1)))

    return in_blocks(lonely, len(rows))


def _compared(points: Vectors, directions: Vectors, rows: Rows, near: Rows) -> tuple[Vectors, Vectors]:
    """Return sines (m, k) of the ways to neighbours over the plane across a direction, and the cosines between two."""
    ways = points[near] - points[rows, None]
    lengths = np.linalg.norm(ways, axis=2)
    rises = np.einsum("nkc,nc->nk", ways, directions[rows]) / np.where(lengths > 0, lengths, 1)
    return rises, np.einsum("nkc,nc->nk", directions[near], directions[rows])
