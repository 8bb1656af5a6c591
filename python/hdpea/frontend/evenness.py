# SPDX-License-Identifier: GPL-3.0-or-later
"""How far apart a surface is sampled, and which points stand for it where they crowd on scan lines."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.clumps import clump_distance, count_apart
from hdpea.frontend.crowds import FEWEST, STEP, crowds_lie_across, nearest_kept, quiet_count
from hdpea.geometry.thinning import farthest_rows
from hdpea.runtime.blocks import in_blocks

NEAR, FAR = 4, 14
"""Nearest points whose distances tell the dimension of what lies between: from beyond chance on, and not as far as the
lines that cross one or lie beside it."""

AVERAGED = 32
"""Neighbours over which it is averaged, or chance would tell: their estimates spread by a tenth."""

LINE_DIMENSION = 1.5
"""Dimension under which points lie on lines: surfaces have 2.0, 1.4 by chance, noisy ones more, rings of 15:1 1.1."""

LEAST_SHARE = 0.3
"""Least share of the surface sampled along lines, by the disks that points have, that makes a cloud uneven.

Of 813 clouds of 271 meshes (800 to 40,000 points) it is 0.02 and less, but for two of 800 points, 0.17 and 0.23; of
rings from 5:1 on 1; of lines both ways 0.4 and more from 10:1 on; of a lidar's ground 0.86 and more, though the far
rings are a small share of its points."""

TWIN, MOST_TWINS = 0.25, 0.35
"""Distance to the nearest point, in spacings, under which the two are twins, and the share of these that makes a cloud
uneven: a place that was seen twice or three times has no line of points.

Of points spread at random 0.18 are twins, of frames along the same rays with noise of up to 0.2 spacings 0.45 to 1."""

FEWEST_PLACES = 100
"""Fewer places say nothing of how they are spread."""

SURROUNDING = 10
"""Nearest points of a level whose disk tells how much surface each of them has for itself."""

COVERED = 2.5
"""Area for each point, in squares of their least distance, under which a level covers the surface in all directions.

Farthest points of an even cloud have 1.6 to 2.2; on lines it is 1.3 times the gap between them in steps along them."""

KEPT_DETAIL = 7.0
"""Area for each point, in the same squares, under which points are kept: five points along a line for each gap.

Fewer lose detail, more are lines again: means of eight raw scans of rings, rms in 1e-3 of the diagonal, were 2.3, 2.1,
1.9, 2.0 for 3.5, 5, 7 and 10, and 4.7 with all points kept."""


@dataclass(frozen=True)
class Sampling:
    """How a surface is sampled.

    Attributes
    ----------
    spacing
        (n,) float64: how far apart points are in the sparser direction, the side of the square of surface that each has
        for itself once the points on lines are no nearer to each other than the lines are.
    kept
        (n,) bool: the points that stand for all. The others lie between these on lines; all are kept of an even cloud.
    stands_for
        (n,) int64: the kept point that stands for each: the nearest.
    on_lines
        Share of the surface that is sampled along lines: 0 for an even cloud.
    """

    spacing: NDArray[np.float64]
    kept: NDArray[np.bool_]
    stands_for: NDArray[np.int64]
    on_lines: float


NEIGHBORS = max(FAR, AVERAGED)
"""Nearest points that are looked at."""


def sampling_of(points: NDArray[np.float64], nearest: NDArray[np.int64]) -> Sampling:
    """Find how densely points (n, 3) sample their surface, and which are needed where they crowd on lines.

    Of each the `nearest` (n, 32) are known.

    Lines are told by the local dimension (Levina and Bickel, "Maximum likelihood estimation of intrinsic dimension",
    2004). Of points in clumps one stands for each. Where many points lie on lines, or nearly at the same places, the
    cloud is looked at in levels, each its farthest points (Eldar et al., "The farthest point strategy for progressive
    image sampling", 1997), which have a least distance: on the first level whose points have no more surface for
    themselves than this allows for, they surround each other on all sides. It does not matter how dense lines are, nor
    whether they cross. Neither moving, turning nor scaling makes a difference.
    """
    areas = _areas(points, nearest)
    on_lines = _share_on_lines(points, nearest, areas)
    clump = clump_distance(points, nearest)
    of_all = Sampling(_even_spacing(areas, nearest), np.ones(len(points), dtype=bool), np.arange(len(points)), on_lines)
    if on_lines < LEAST_SHARE and _share_of_twins(points, nearest, areas) < MOST_TWINS and not clump:
        return replace(of_all, on_lines=0.0)
    order = farthest_rows(points, len(points))
    if clump and (places := count_apart(points, order, clump)) < len(points):
        return _sampling_of_places(points, order[:places]) if places >= FEWEST_PLACES else of_all
    return _sampling_by_levels(points, order, of_all)


def _sampling_by_levels(points: NDArray[np.float64], order: NDArray[np.int64], of_all: Sampling) -> Sampling:
    """Return how an uneven cloud (n, 3) is sampled, by levels of the first in the `order` (n,) of the farthest.

    What is covered on no level, as wires are, stays as it is `of_all` points.
    """
    rank = np.empty(len(points), dtype=np.int64)
    rank[order] = np.arange(len(points))
    spacing = np.zeros(len(points))
    # How many of the first points are enough at each, for all detail along lines, and to cover the surface.
    enough = {most: np.zeros(len(points), dtype=np.int64) for most in (KEPT_DETAIL, COVERED)}
    count = round(len(points) / STEP)
    while count >= FEWEST and (spacing == 0).any():
        level = np.ascontiguousarray(points[order[:count]])
        least = np.linalg.norm(level[:-1] - level[-1], axis=1).min()
        count, of_level = round(count / STEP), count
        share, own = _share_of(level, least)
        at = _core.nearest_neighbors(level, points, 1)[:, 0]
        for most, counts in enough.items():
            counts[(counts == 0) & (share[most][at] >= 0.5)] = of_level
        covered = (spacing == 0) & (share[COVERED][at] >= 0.5)
        spacing[covered] = own[at[covered]]
    spacing = np.where(spacing == 0, of_all.spacing, spacing)
    detailed, covering = (rank < np.where(counts == 0, len(points), counts) for counts in enough.values())
    kept = detailed
    if crowds_lie_across(points, covering):
        kept = rank < quiet_count(points, order, int(covering.sum()), int(detailed.sum()))
    return Sampling(spacing, kept, nearest_kept(points, kept), of_all.on_lines)


def _share_on_lines(points: NDArray[np.float64], nearest: NDArray[np.int64], areas: NDArray[np.float64]) -> float:
    """Return which share of the surface points (n, 3) sample along lines; 0 where all are at one place."""
    whole = float(areas.sum())
    return float(areas[_dimension(points, nearest) < LINE_DIMENSION].sum()) / whole if whole > 0 else 0.0


def _dimension(points: NDArray[np.float64], nearest: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the dimension (n,) of what points (n, 3) show around each, by those `nearest` (n, k) to it."""
    near, far = (np.linalg.norm(points[nearest[:, count - 1]] - points, axis=1) for count in (NEAR, FAR))
    tiny = np.finfo(np.float64).tiny
    growth = np.log(np.maximum(far, tiny) / np.maximum(near, tiny))
    # What it is on a plane, on average: half the sum of 1 / k for k from NEAR to FAR - 1.
    on_a_plane = (1 / np.arange(NEAR, FAR)).sum() / 2
    averaged = in_blocks(lambda block: growth[nearest[block, :AVERAGED]].mean(axis=1), len(points))
    return np.asarray(2 * on_a_plane / np.maximum(averaged, tiny))


def _sampling_of_places(points: NDArray[np.float64], rows: NDArray[np.int64]) -> Sampling:
    """Return how a surface is sampled of whose points (n, 3) those in `rows` lie at a place each, the others there."""
    places = np.ascontiguousarray(points[rows])
    found = sampling_of(places, _core.nearest_neighbors(places, NEIGHBORS))
    kept = np.zeros(len(points), dtype=bool)
    kept[rows[found.kept]] = True
    at = _core.nearest_neighbors(places, points, 1)[:, 0]
    return Sampling(found.spacing[at], kept, nearest_kept(points, kept), found.on_lines)


def _share_of_twins(points: NDArray[np.float64], nearest: NDArray[np.int64], areas: NDArray[np.float64]) -> float:
    """Return which share of points (n, 3) has another one at its place but for noise."""
    apart = np.square(points[nearest[:, 0]] - points).sum(axis=1)
    return float((apart < TWIN**2 * areas).mean())


def _share_of(level: NDArray[np.float64], least: float) -> tuple[dict[float, NDArray[np.float64]], NDArray[np.float64]]:
    """Return which share of the points around each of a level (m, 3) have so little surface, and the square's side."""
    nearest = _core.nearest_neighbors(level, SURROUNDING)
    area = _areas(level, nearest)
    around = np.concatenate([np.arange(len(level))[:, None], nearest[:, :-2]], axis=1)
    shares = {most: (area < most * least**2)[around].mean(axis=1) for most in (COVERED, KEPT_DETAIL)}
    return shares, np.sqrt(np.median(area[around], axis=1))


def _even_spacing(areas: NDArray[np.float64], nearest: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the side (n,) of the square of surface that each of evenly spread points has for itself."""
    around = in_blocks(lambda block: np.median(areas[nearest[block, :SURROUNDING]], axis=1), len(areas))
    return np.asarray(np.sqrt(around))


def _areas(points: NDArray[np.float64], nearest: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the area (n,) of surface that each of points (n, 3) has for itself, by the disk that its nearest fill."""
    return np.asarray(np.pi * np.square(points[nearest[:, SURROUNDING - 1]] - points).sum(axis=1) / SURROUNDING)
