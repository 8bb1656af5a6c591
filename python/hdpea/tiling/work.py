# SPDX-License-Identifier: GPL-3.0-or-later
"""What every task of a tiled reconstruction is given, and tiles as tasks find them in the work folder."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.embedding.tangents import tangent_bases
from hdpea.options import Options
from hdpea.surface.surface import Surface
from hdpea.tiling.folder import WorkFolder
from hdpea.tiling.plan import Plan

ALIKE = 12
"""Nearest points among which one that faces as a particle does is taken for the one below it."""


@dataclass(frozen=True)
class Work:
    """A tiled reconstruction: where its files are, its tiles, and what was asked for."""

    folder: WorkFolder
    plan: Plan
    options: Options


class Agreed(NamedTuple):
    """What all tiles go by.

    Attributes
    ----------
    spacing
        In R^3 of as many vertices as the points can show, in the unit frame.
    resolution
        How many these are.
    vertices, particles
        How many are wanted, and how many to spread.
    per_vertex
        Points for each vertex that they can show.
    """

    spacing: float
    resolution: int
    vertices: int
    particles: int
    per_vertex: float

    @property
    def share_kept(self) -> float:
        """Share of the particles that stay vertices."""
        return min(self.vertices / self.particles, 1.0)

    @classmethod
    def of(cls, work: Work) -> Agreed:
        """Return what was agreed on."""
        facts = work.folder.facts("agreed")
        return cls(*(facts[name] for name in cls._fields))


@dataclass(frozen=True)
class EmbeddedTile:
    """The surface of a tile and its halo, and where it lies in its own R^8.

    Attributes
    ----------
    surface
        In the unit frame of the whole cloud.
    coordinates
        (n, 8) float64.
    bases
        (n, 2, 8) float64: its tangent planes.
    """

    surface: Surface
    coordinates: NDArray[np.float64]
    bases: NDArray[np.float64]

    @classmethod
    def of(cls, work: Work, tile: int) -> EmbeddedTile:
        """Return a tile that was embedded."""
        surface, coordinates = surface_of(work, tile), work.folder.load("embedded", tile)["coordinates"]
        per_vertex = Agreed.of(work).per_vertex
        return cls(surface, coordinates, tangent_bases(coordinates, surface.normals, surface.neighbors, per_vertex))

    def lifted(
        self, positions: NDArray[np.float64], normals: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Return places (m, 3) that face along `normals` in this tile's R^8 (m, 8), and the points (m,) below them.

        Each tile solves for psi alone, up to a motion of R^5: what tiles share is R^3.
        """
        points = self.surface.points_in_unit
        near = _core.nearest_neighbors(points, np.ascontiguousarray(positions), min(ALIKE, len(points)))
        alike = np.einsum("mkc,mc->mk", self.surface.normals[near], normals) > 0
        nearest = np.take_along_axis(near, alike.argmax(axis=1)[:, None], axis=1)[:, 0]
        offsets, planes = positions - points[nearest], self.bases[nearest]
        in_space = planes[:, :, :3]  # (m, 2, 3)
        products = in_space @ in_space.swapaxes(1, 2)  # (m, 2, 2)
        along = np.linalg.solve(products, in_space @ offsets[:, :, None])  # (m, 2, 1)
        lifted = self.coordinates[nearest] + (along.swapaxes(1, 2) @ planes)[:, 0]
        return np.ascontiguousarray(lifted), np.asarray(nearest)


def surface_of(work: Work, tile: int) -> Surface:
    """Return the surface of a tile and its halo as all tiles agree it faces, in the unit frame of the whole cloud."""
    kept, sides = work.folder.load("prepared", tile), work.folder.load("agreed")[f"sides{tile}"]
    normals = kept["normals"] * sides[:, None]
    if (sides == -1).any() and (sides == 1).any():
        # What faced opposite ways was no neighbour.
        return Surface.of(work.plan.frame, kept["points"], normals)
    spacing = work.folder.facts("prepared", tile)["spacing"]
    return Surface(work.plan.frame, kept["points"], normals, kept["neighbors"].astype(np.int64), spacing)
