# SPDX-License-Identifier: GPL-3.0-or-later
"""From the particles of all tiles to one mesh: triangles tile by tile, one extraction."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.triangles import circumradii
from hdpea.mesh.cells import restricted_cells
from hdpea.mesh.coverage import covered
from hdpea.mesh.extraction import DISK_RADIUS, join_triangles, smallest_disk
from hdpea.mesh.particles import Particles
from hdpea.surface.surface import area_shown
from hdpea.tiling.spreading import Placed
from hdpea.tiling.work import Agreed, EmbeddedTile, Work

ANY_SIZE = 1e6
"""Radius of disks, in units of their own, that refuses no triangle: each tile has refused those that are too large in
its R^8, and between tiles there is none."""


def propose(work: Work, tile: int) -> None:
    """Propose the triangles of a tile: those whose first corner, in the order of all particles, is one of its own."""
    agreed, embedded = Agreed.of(work), EmbeddedTile.of(work, tile)
    around = sorted([tile, *np.flatnonzero(work.plan.neighbors[tile]).tolist()])
    found = [Placed.of(work, each) for each in around]
    # Its own may lie beyond its box: they are all in its halo.
    rows = [each.near(work, tile) for each in found]
    owner = np.repeat(around, [len(each) for each in rows])
    number = np.concatenate(rows)
    if len(number) < 4:
        empty = {"owners": np.empty((0, 3), np.int64), "numbers": np.empty((0, 3), np.int64)}
        work.folder.save("triangles", tile, {**empty, "counts": np.empty(0, np.int32), "radii": np.empty(0)})
        return
    positions = np.vstack([each.positions[near] for each, near in zip(found, rows, strict=True)])
    normals = np.vstack([each.normals[near] for each, near in zip(found, rows, strict=True)])
    particles = Particles(*embedded.lifted(positions, normals))
    candidates, radii = restricted_cells(particles.coordinates, embedded.bases[particles.nearest], DISK_RADIUS)
    resolution = max(round(_area(embedded) / agreed.spacing**2), 4)
    candidates = covered(candidates, particles, embedded.surface, resolution)
    limit = _core.ExtractionOptions().max_circumradius * np.median(radii[candidates.triangles], axis=1)
    corners = particles.coordinates[candidates.triangles]
    kept = (owner[candidates.triangles[:, 0]] == tile) & (circumradii(corners) <= limit)
    triangles = candidates.triangles[kept]
    arrays = {
        "owners": owner[triangles],
        "numbers": number[triangles],
        "counts": candidates.counts[kept],
        "radii": radii[owner == tile],
    }
    work.folder.save("triangles", tile, arrays)


def _area(embedded: EmbeddedTile) -> float:
    return area_shown(embedded.surface.points_in_unit, embedded.surface.neighbors)


def join(work: Work) -> None:
    """Choose a manifold mesh from the triangles of all tiles, and fill its holes."""
    agreed, tiles = Agreed.of(work), range(work.plan.tiles)
    placed = [Placed.of(work, tile) for tile in tiles]
    proposed = [work.folder.load("triangles", tile) for tile in tiles]
    first = np.concatenate([[0], np.cumsum([len(each.positions) for each in placed])])
    triangles = np.vstack([first[each["owners"]] + each["numbers"] for each in proposed])
    counts = np.concatenate([each["counts"] for each in proposed])
    positions, normals = (np.vstack([getattr(each, name) for each in placed]) for name in Placed._fields)
    candidates = _core.Candidates(np.sort(triangles, axis=1), counts, np.ones(len(positions)))
    mesh = join_triangles(
        candidates,
        positions,
        normals,
        np.full(len(positions), ANY_SIZE),
        work.plan.frame,
        work.options.meshing,
        agreed.share_kept,
        agreed.resolution,
    )
    disks = smallest_disk(np.concatenate([each["radii"] for each in proposed]), work.plan.frame)
    choices = [asdict(choice) for choice in (disks, *mesh.choices)]
    facts = {"statistics": mesh.statistics, "particles": len(positions), "choices": choices}
    save_mesh(work, 0, mesh.vertices_in_unit, mesh.faces, mesh.patches, facts)


def save_mesh(
    work: Work,
    stage: int,
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    patches: NDArray[np.float64],
    facts: dict[str, object],
) -> None:
    """Keep the mesh as it is after the tiles of so many colours were finished."""
    work.folder.save("mesh", stage, {"vertices": vertices, "faces": faces, "patches": patches}, facts)
