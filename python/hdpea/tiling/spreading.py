# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles tile after tile: those of earlier neighbours stay where they are."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hdpea.mesh.assembly import spreading_options
from hdpea.mesh.particles import Particles, spread_particles
from hdpea.tiling.work import Agreed, EmbeddedTile, Work


class Placed(NamedTuple):
    """Particles as tiles share them: positions (m, 3) in the unit frame, and where their points face, (m, 3)."""

    positions: NDArray[np.float64]
    normals: NDArray[np.float64]

    @classmethod
    def of(cls, work: Work, tile: int) -> Placed:
        """Return those that a tile has placed."""
        kept = work.folder.load("particles", tile)
        return cls(kept["positions"], kept["normals"])

    def near(self, work: Work, tile: int) -> NDArray[np.int64]:
        """Return which of them lie in a tile or its halo."""
        return np.flatnonzero(work.plan.inside(tile, self.positions, work.plan.halo))


def spread(work: Work, tile: int) -> None:
    """Place the particles of a tile beside those that its earlier neighbours have placed.

    All tiles spread equally many for an area in R^8. In the halos of later neighbours they are spread as well, so that
    those at the border have others on both sides, and are left out in the end: the neighbour places its own.
    """
    agreed, embedded = Agreed.of(work), EmbeddedTile.of(work, tile)
    surface, earlier = embedded.surface, work.plan.earlier(tile)
    placed = _placed_by(work, tile, earlier, embedded)
    later = [each for each in np.flatnonzero(work.plan.neighbors[tile]).tolist() if each not in earlier]
    whole = sum(work.folder.facts("embedded", each)["area"] for each in range(work.plan.tiles))
    area = sum(_area_within(work, each, tile) for each in [tile, *later])
    free = ~_inside_any(work, earlier, surface.points_in_unit)
    if placed is not None:
        free[placed.nearest] = False
    count = min(round(agreed.particles * area / whole), int(free.sum()))
    positions, normals = np.empty((0, 3)), np.empty((0, 3))
    if count > 0:
        options, _ = spreading_options(work.options.particles, evened=agreed.particles > agreed.vertices)
        spread = spread_particles(
            embedded.coordinates,
            embedded.bases,
            surface.neighbors,
            count,
            options=options,
            device=work.options.embedding.device,
            placed=placed,
            free=free,
        )
        positions = np.ascontiguousarray(spread.coordinates[:, :3])
        kept = ~_inside_any(work, later, positions)
        positions, normals = positions[kept], surface.normals[spread.nearest[kept]]
    work.folder.save("particles", tile, {"positions": positions, "normals": normals}, {"count": len(positions)})


def _placed_by(work: Work, tile: int, earlier: list[int], embedded: EmbeddedTile) -> Particles | None:
    found = [Placed.of(work, each) for each in earlier]
    rows = [each.near(work, tile) for each in found]
    if not sum(map(len, rows)):
        return None
    positions = np.vstack([each.positions[near] for each, near in zip(found, rows, strict=True)])
    normals = np.vstack([each.normals[near] for each, near in zip(found, rows, strict=True)])
    return Particles(*embedded.lifted(positions, normals))


def _area_within(work: Work, owner: int, tile: int) -> float:
    """Return the area in R^8 of what a tile owns and another, or itself, knows.

    By the owner's count, as points at the rim of a halo lack neighbours, which makes their share of it too large.
    """
    prepared = work.folder.load("prepared", owner)
    within = prepared["own"] & work.plan.inside(tile, prepared["points"], work.plan.halo)
    return float(work.folder.load("embedded", owner)["areas"][within].sum())


def _inside_any(work: Work, tiles: list[int], points: NDArray[np.float64]) -> NDArray[np.bool_]:
    inside = np.zeros(len(points), dtype=bool)
    for tile in tiles:
        inside |= work.plan.inside(tile, points)
    return inside
