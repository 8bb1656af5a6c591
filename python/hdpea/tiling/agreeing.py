# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side is out: what all tiles must agree on, beside the numbers, decided from what each has found."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.linked import first_linked
from hdpea.tiling.numbers import numbers_of
from hdpea.tiling.work import Work

Piece = tuple[int, int]
"""A tile, and one of the connected pieces of its surface: patches that face opposite ways are pieces of their own."""

Votes = dict[tuple[Piece, Piece], float]
"""Of two pieces, by how much more of the points say that they face to one side than that they do not."""

BESIDE = 8
"""Nearest points of a point by which a tile falls into pieces, and by which those are found that lie side by side."""

FLATTEST, LEAST_AGREEMENT = 0.3, 0.8
"""Sine of the largest angle between a normal and the plane across a point beside it, and the least cosine, of either
sign, between two normals, by which two points are taken to be of one sheet."""


def agree(work: Work) -> None:
    """Turn the pieces of the tiles to one side, and choose the spacing and the numbers that all tiles go by."""
    numbers = numbers_of(work)
    sides = _sides(work) if numbers["computed_sides"] else _as_they_are(work)
    work.folder.save("agreed", None, sides, numbers)


def _as_they_are(work: Work) -> dict[str, NDArray[np.int8]]:
    return {f"sides{t}": np.ones(len(work.folder.load("prepared", t)["own"]), np.int8) for t in range(work.plan.tiles)}


def _sides(work: Work) -> dict[str, NDArray[np.int8]]:
    """Return for each point of each tile whether its normal stays (1) or is turned (-1).

    Where the halos overlap, the points of two pieces vote on whether both face to one side, and so do points of one
    tile beside each other; the clearest votes count first (a spanning forest of most votes). Pieces whose sides the
    file knows stay.
    """
    labels = dict[int, NDArray[np.int64]]()
    votes: Votes = {}
    fixed = {t for t in range(work.plan.tiles) if not work.folder.facts("prepared", t)["computed_sides"]}
    for tile in range(work.plan.tiles):
        kept = work.folder.load("prepared", tile)
        labels[tile] = pieces(kept["neighbors"])
        _vote_within(tile, kept["points"], kept["normals"], labels[tile], votes)
        for other in np.flatnonzero(work.plan.neighbors[tile, :tile]).tolist():
            _vote(work, (tile, kept["given"], kept["normals"], labels[tile]), other, labels[other], votes)
    signs = _signs(labels, votes, fixed)
    return {
        f"sides{tile}": np.array([signs[tile, each] for each in range(label.max() + 1)], np.int8)[label]
        for tile, label in labels.items()
    }


def _vote(
    work: Work,
    own: tuple[int, NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]],
    other: int,
    labels: NDArray[np.int64],
    votes: Votes,
) -> None:
    """Add the votes of the points that two tiles share: those in the box of either."""
    tile, points, normals, own_labels = own
    theirs = work.folder.load("prepared", other)
    shared = np.flatnonzero(work.plan.inside(tile, points) & work.plan.inside(other, points, work.plan.halo))
    shared = np.union1d(shared, np.flatnonzero(work.plan.inside(other, points)))
    if len(shared) == 0:
        return
    same = _core.nearest_neighbors(theirs["given"], np.ascontiguousarray(points[shared]), 1)[:, 0]
    near = np.linalg.norm(theirs["given"][same] - points[shared], axis=1) < 1e-9
    shared, same = shared[near], same[near]
    agreement = np.einsum("nc,nc->n", normals[shared], theirs["normals"][same])
    _count(votes, (tile, own_labels[shared]), (other, labels[same]), agreement)


def _vote_within(
    tile: int,
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    labels: NDArray[np.int64],
    votes: Votes,
) -> None:
    """Add the votes of points of one tile beside each other, along one sheet, that are of two pieces."""
    if labels.max(initial=0) == 0:
        return
    near = _core.nearest_neighbors(points, min(BESIDE, len(points) - 1))
    one, other = np.repeat(np.arange(len(points)), near.shape[1]), near.ravel()
    apart = labels[one] != labels[other]
    one, other = one[apart], other[apart]
    offsets = points[other] - points[one]
    agreement = np.einsum("pc,pc->p", normals[one], normals[other])
    slopes = np.abs(np.einsum("pc,pc->p", offsets, normals[one])) / np.linalg.norm(offsets, axis=1)
    same_sheet = (slopes < FLATTEST) & (np.abs(agreement) > LEAST_AGREEMENT)
    one, other = one[same_sheet], other[same_sheet]
    _count(votes, (tile, labels[one]), (tile, labels[other]), agreement[same_sheet])


def _count(
    votes: Votes,
    one: tuple[int, NDArray[np.int64]],
    other: tuple[int, NDArray[np.int64]],
    agreement: NDArray[np.float64],
) -> None:
    """Add how much the points (p,) of two tiles agree to the votes of the pieces (p,) that they are of."""
    pairs, inverse = np.unique(np.stack([one[1], other[1]], axis=1), axis=0, return_inverse=True)
    for (mine, their), sum_ in zip(pairs.tolist(), np.bincount(inverse.ravel(), agreement, len(pairs)), strict=True):
        key = (one[0], mine), (other[0], their)
        votes[key] = votes.get(key, 0.0) + float(sum_)


def _signs(labels: dict[int, NDArray[np.int64]], votes: Votes, fixed: set[int]) -> dict[Piece, int]:
    """Return the sign of each piece, from the clearest votes to the faintest."""
    leader = {(tile, each): (tile, each) for tile, label in labels.items() for each in range(label.max() + 1)}
    sign = dict.fromkeys(leader, 1)
    members = {piece: [piece] for piece in leader}
    held = {piece: piece[0] in fixed for piece in leader}
    for (a, b), sum_ in sorted(votes.items(), key=lambda vote: (-abs(vote[1]), vote[0])):
        first, second = leader[a], leader[b]
        if first == second or (held[first] and held[second]):
            continue
        # The group that is held, or else the larger one, stays as it is.
        if (held[second], len(members[second])) > (held[first], len(members[first])):
            first, second = second, first
        turn = 1 if sum_ * sign[a] * sign[b] >= 0 else -1
        for piece in members.pop(second):
            leader[piece], sign[piece] = first, sign[piece] * turn
            members[first].append(piece)
    return sign


def pieces(neighbors: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return the number (n,) of the connected piece that each point belongs to, by its `neighbors` (n, k), -1: none."""
    rows, columns = np.nonzero(neighbors[:, :BESIDE] >= 0)
    firsts = first_linked(len(neighbors), rows, neighbors[rows, columns])
    return np.unique(firsts, return_inverse=True)[1]
