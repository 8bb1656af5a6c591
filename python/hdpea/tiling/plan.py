# SPDX-License-Identifier: GPL-3.0-or-later
"""How a cloud is cut into tiles: boxes, halos, and which tiles must wait for which."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import Options
from hdpea.tiling.cells import Cells

TILE_POINTS = 400_000
"""Most points of a tile, halo included, if the memory has room for as many; twice as many, or four times, where those
would be all halo. It is no share of the memory, so that the bytes of a mesh do not depend on the machine."""

HALO, HALO_OF_VERTICES = 12.0, 8.0
"""Width of the halos in spacings of as many vertices as the points can show, and in those of the vertices wanted,
whichever is wider."""

COLLAR, APART = 0.4, 0.4
"""How far beyond a tile its mesh is edited, and how far apart at least what two tiles edit that are not neighbours, in
halos."""

LEAST_CORE = 0.03
"""A tile is not cut further if it has less than this share of the points that it may have: the rest is its halo."""


@dataclass(frozen=True)
class Plan:
    """The tiles of a cloud.

    Attributes
    ----------
    frame
        The unit frame of the whole cloud, in which all tiles are worked on.
    points
        Finite points of the cloud.
    low, high
        (t, 3) float64, the corners of the tiles' boxes in the unit frame; infinite where the cloud ends.
    halo
        How far beyond its box a tile knows the points, in the unit frame.
    neighbors
        (t, t) bool, symmetric: tiles that know points of each other.
    tile_points
        Most points that a tile may know.
    """

    frame: UnitFrame
    points: int
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    halo: float
    neighbors: NDArray[np.bool_]
    tile_points: int

    @property
    def tiles(self) -> int:
        """How many there are."""
        return len(self.low)

    @property
    def collar(self) -> float:
        """How far beyond its box the mesh of a tile is edited."""
        return COLLAR * self.halo

    def colors(self) -> NDArray[np.int64]:
        """Return a number for each tile (t,), different from that of every neighbour, as small as can be, in order."""
        colors = np.full(self.tiles, -1)
        for tile in range(self.tiles):
            taken = set(colors[self.neighbors[tile]].tolist())
            colors[tile] = next(color for color in range(self.tiles) if color not in taken)
        return colors

    def earlier(self, tile: int) -> list[int]:
        """Return the neighbours of a tile that come before it: of a lower colour."""
        colors = self.colors()
        return np.flatnonzero(self.neighbors[tile] & (colors < colors[tile])).tolist()

    def inside(self, tile: int, points: NDArray[np.float64], beyond: float = 0.0) -> NDArray[np.bool_]:
        """Return which points (n,) lie in the box of a tile, or at most so far `beyond` it along each axis."""
        above, below = points >= self.low[tile] - beyond, points < self.high[tile] + beyond
        return np.asarray((above & below).all(axis=1))


def plan_tiles(
    cells: Cells, frame: UnitFrame, options: Options, tile_points: int, most_points: int | None = None
) -> Plan:
    """Cut a cloud into tiles of at most `tile_points`, halo included, or else twice as many, up to `most_points`.

    Boxes are halved by the number of points along their longest side until they are small enough.

    Parameters
    ----------
    most_points
        How many there is room for: where tiles of `tile_points` would be all halo, larger ones are tried. Default: no
        more than `tile_points`.

    Raises
    ------
    UsageError
        If the halos alone hold more points than that.
    """
    points = int(cells.counts.sum())
    area = cells.area()
    shown = float(np.sqrt(area / options.resolution_of(points)))
    halo = max(HALO * shown, HALO_OF_VERTICES * float(np.sqrt(area / options.vertices_of(points))))
    while (boxes := _boxes(cells, halo, tile_points)) is None:
        if 2 * tile_points > (most_points or tile_points):
            raise UsageError(
                f"Tiles of {tile_points:,} points are all halo.", "Give more `memory`, or ask for more vertices."
            )
        tile_points *= 2
    lows, highs = np.array([low for low, _ in boxes]), np.array([high for _, high in boxes])
    return Plan(frame, points, lows, highs, halo, _neighbors(cells, lows, highs, halo), tile_points)


def _boxes(cells: Cells, halo: float, most_points: int) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]] | None:
    """Return the corners of boxes that know at most so many points each; None if they would be all halo."""
    boxes = list[tuple[NDArray[np.float64], NDArray[np.float64]]]()
    waiting = [(np.full(3, -np.inf), np.full(3, np.inf))]
    while waiting:
        low, high = waiting.pop()
        known, core = cells.points_in(low - halo, high + halo), cells.points_in(low, high)
        if known <= most_points:
            boxes.append((low, high))
            continue
        if core < LEAST_CORE * most_points:
            return None
        if cells.in_box(low, high).sum() < 2:
            raise UsageError(
                f"{core:,} points lie in one place, as seen from the farthest ones; a tile holds {most_points:,}.",
                "Give more `memory`, or leave out points that are far away.",
            )
        axis, middle = cells.middle_of(low, high)
        left, right = high.copy(), low.copy()
        left[axis] = right[axis] = middle
        waiting += [(right, high), (low, left)]
    return boxes


def _neighbors(cells: Cells, low: NDArray[np.float64], high: NDArray[np.float64], halo: float) -> NDArray[np.bool_]:
    """Return which tiles know points of each other, or both edit the mesh in one place."""
    core = np.array([cells.in_box(a, b) for a, b in zip(low, high, strict=True)])
    known = np.array([cells.in_box(a - halo, b + halo) for a, b in zip(low, high, strict=True)])
    # Half of what is to lie between them belongs to each.
    claimed = (COLLAR + APART / 2) * halo
    edited = np.array([cells.in_box(a - claimed, b + claimed) for a, b in zip(low, high, strict=True)])
    sees = (known.astype(np.float32) @ core.T.astype(np.float32)) > 0
    both = (edited.astype(np.float32) @ edited.T.astype(np.float32)) > 0
    neighbors = np.asarray(sees | sees.T | both)
    np.fill_diagonal(neighbors, False)
    return neighbors
