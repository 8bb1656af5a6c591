# SPDX-License-Identifier: GPL-3.0-or-later
"""Sheets: points that pass for strays since they are sparse, and lie along a surface all the same."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.standing import FARTHER, usual
from hdpea.geometry.covariances import covariances

SHEET_POINTS, FLAT = 16, 0.1
"""Nearest points with which a point lies in a sheet, and the ratio of their deviations across and along, the lesser of
the two, up to which they do: of 3,600 strays in the boxes of 20 models 14 come to it, one by one."""

SHEET, SHEET_COMPANY = 10, 2
"""Of these nearest points how many must be no strays themselves, and how many be taken back with it.

Sheets that are sparser than what they border on come back, 382 of the 8,075 points of CGAL's point_set_3, and none of
200 strays around each of 40 models."""

SPARSE_POINTS, SPARSE_COMPANY = 8, 4
"""Nearest *strays* with which one lies in a sheet by itself, the far side of a thin wall that was seen at a slant: most
of its nearest points are of the near side. And how many of them must lie in it, too."""

THIN, LESS_THIN = 0.1, 0.2
"""Deviation across such a sheet, in distances to the eighth of the points around that are no strays; and where most of
its company lies in one already.

Of 544 points of surfaces in eight depth frames each of 20 models that pass for strays 248 come back, of 4,832 flying
pixels 15, next to these; and none of 3,600 strays in the boxes of the models."""

FARTHEST = 4.0
"""Distance to the eighth stray in the same unit: flying pixels have 4.4 and more."""

LEAST_WIDTH = 0.15
"""Width by length of a sheet: a line is none, nor are three points far from an edge together with that."""

NEXT_TO = 8
"""Nearest points among which one in a sheet has its next, on the way to what is no stray: heaps far from everything are
strays. The overseas post offices of CGAL's poste_france would get nearly all of its vertices."""


def strays_in_sheets(
    points: NDArray[np.float64], nearest: NDArray[np.int64], strays: NDArray[np.bool_]
) -> NDArray[np.int64]:
    """Return the rows of those strays that are none: they lie in flat sheets of such points.

    Where a surface is sampled several times more sparsely than beside, a search for strays takes a strip of it, and
    round after round another.

    Parameters
    ----------
    points
        (n, 3) float64.
    nearest
        (n, 16) or more: the nearest other points of each.
    strays
        (n,): which points pass for strays.
    """
    rows = np.flatnonzero(strays)
    in_sheet = _among_others(points, nearest, strays, rows) | _by_themselves(points, nearest, rows)
    return np.asarray(rows[_border_on(~strays, rows, nearest[rows, :NEXT_TO], in_sheet)])


def _among_others(
    points: NDArray[np.float64], nearest: NDArray[np.int64], strays: NDArray[np.bool_], rows: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Return which of the `rows` of strays lie in a flat sheet of points most of which are none, (m,)."""
    near = nearest[rows, :SHEET_POINTS]
    variances = _variances(points, np.column_stack([rows, near]))
    back = np.zeros(len(points), dtype=bool)
    flat = variances[:, 0] < FLAT**2 * variances[:, 1]
    back[rows] = flat & (variances[:, 1] > LEAST_WIDTH**2 * variances[:, 2])
    while True:
        held = back[rows] & ((~strays | back)[near].sum(axis=1) >= SHEET) & (back[near].sum(axis=1) >= SHEET_COMPANY)
        if held.sum() == back.sum():
            return np.asarray(held)
        back[rows] = held


def _by_themselves(
    points: NDArray[np.float64], nearest: NDArray[np.int64], rows: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Return which of the `rows` of strays lie in a flat sheet of strays, not much sparser than what is near, (m,)."""
    if len(rows) <= SPARSE_POINTS:
        return np.zeros(len(rows), dtype=bool)
    strays = np.ascontiguousarray(points[rows])
    near = _core.nearest_neighbors(strays, strays, SPARSE_POINTS + 1)
    variances = _variances(strays, near)
    beside = nearest[rows, :SPARSE_POINTS]
    apart = np.linalg.norm(points[nearest[beside, SPARSE_POINTS - 1]] - points[beside], axis=2)
    unit = usual(apart)
    wide = variances[:, 1] > LEAST_WIDTH**2 * variances[:, 2]
    reached = np.linalg.norm(strays[near[:, -1]] - strays, axis=1)
    # Strays are some times in the plane of two rows of others.
    wide &= reached < np.minimum(FARTHEST * unit, FARTHER * np.median(reached[near[:, 1:]], axis=1))
    thickness = np.sqrt(variances[:, 0])
    thin = wide & (thickness < THIN * unit)
    sheet = thin & (thin[near[:, 1:]].sum(axis=1) >= SPARSE_COMPANY)
    others = wide & (thickness < LESS_THIN * unit)
    while True:
        wider = sheet | (others & (sheet[near[:, 1:]].sum(axis=1) >= SPARSE_COMPANY))
        if wider.sum() == sheet.sum():
            return np.asarray(sheet)
        sheet = wider


def _variances(points: NDArray[np.float64], groups: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the variances (m, 3), ascending, of the points (n, 3) of each group (m, k)."""
    return np.asarray(np.linalg.eigvalsh(covariances(points[groups])).clip(min=0))


def _border_on(
    kept: NDArray[np.bool_], rows: NDArray[np.int64], nearest: NDArray[np.int64], chosen: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Return which of the `rows` (m,), `chosen` (m,) among them, lead to `kept` points (n,) from nearest to nearest."""
    led = kept.copy()
    while True:
        found = chosen & led[nearest].any(axis=1)
        if found.sum() == led[rows].sum():
            return np.asarray(found)
        led[rows] = found
