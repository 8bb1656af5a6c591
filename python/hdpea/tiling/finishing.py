# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh of all particles fitted, simplified and remeshed tile after tile, within a rim that stays as it is.

What a tile leaves unsimplified at its rim lies within its neighbours, which come later.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import HdpeaError
from hdpea.geometry.triangles import vertex_normals
from hdpea.mesh.anisotropic_remeshing import remesh_anisotropically
from hdpea.mesh.creases import align_to_creases, at_corners, find_creases
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.refinement import refine_mesh
from hdpea.mesh.simplification import simplify_mesh
from hdpea.options import MeshingOptions
from hdpea.reading.triangle_mesh import drop_unused
from hdpea.surface.surface import Surface
from hdpea.tiling.joining import save_mesh
from hdpea.tiling.regions import Region, points_at, region_of
from hdpea.tiling.work import Agreed, EmbeddedTile, Work

BEYOND = 0.25
"""How far beyond the edited part its points are taken, in halos: fixed vertices have points on both sides."""

SPARE = 1.03
"""Vertices that tiles leave for each that is wanted. Beside the fixed rim few edges can be collapsed, so that elsewhere
too many are, by 1.5 % of the vertices with 625 to a tile; what is left over, the whole mesh loses in the end."""


def finish(work: Work, tile: int) -> None:
    """Fit and simplify the mesh in a tile and its collar."""
    stage = int(work.plan.colors()[tile])
    whole = work.folder.load("mesh", stage)
    vertices, faces = whole["vertices"], whole["faces"]
    known = work.plan.inside(tile, vertices, work.plan.halo)
    local = np.flatnonzero(known[faces].any(axis=1))
    centres = vertices[faces[local]].mean(axis=1)
    wanted = work.plan.inside(tile, centres, work.plan.collar)
    if not wanted.any():
        work.folder.save(
            "finished", tile, _arrays(np.empty(0, np.int64), whole["vertices"][:0], faces[:0], faces[:0, 0])
        )
        return
    region = region_of(faces[local], wanted, ~known)
    mesh, surface, embedded = _mesh_of(work, tile, vertices, faces[local], region)
    made = _finished(work, tile, mesh, region, surface, embedded)
    arrays = _arrays(local[region.rows], made.vertices_in_unit, made.faces, region.vertices[: region.fixed])
    work.folder.save("finished", tile, arrays)


def _arrays(
    rows: NDArray[np.int64], vertices: NDArray[np.float64], faces: NDArray[np.int64], fixed: NDArray[np.int64]
) -> dict[str, NDArray[np.float64] | NDArray[np.int64]]:
    return {"rows": rows, "vertices": vertices, "faces": faces, "fixed": fixed}


def _mesh_of(
    work: Work, tile: int, vertices: NDArray[np.float64], faces: NDArray[np.int64], region: Region
) -> tuple[Mesh, Surface, EmbeddedTile]:
    """Return a region of the `faces` that a tile knows in the R^8 of the tile, and the points there."""
    embedded, within = EmbeddedTile.of(work, tile), vertices[region.vertices]
    coordinates, _ = embedded.lifted(within, vertex_normals(within, region.faces))
    whole, reach = embedded.surface, work.plan.collar + BEYOND * work.plan.halo
    rows = np.flatnonzero(work.plan.inside(tile, whole.points_in_unit, reach))
    rows = rows[points_at(region, vertices, faces, whole.points_in_unit[rows])]
    surface = Surface(
        whole.frame, whole.points_in_unit[rows], whole.normals[rows], np.empty((len(rows), 0), np.int64), whole.spacing
    )
    near = EmbeddedTile(surface, embedded.coordinates[rows], embedded.bases[rows])
    return Mesh(within, region.faces, coordinates), surface, near


def _finished(work: Work, tile: int, mesh: Mesh, region: Region, surface: Surface, embedded: EmbeddedTile) -> Mesh:
    """Return the mesh fitted to the points, with as many vertices as are this part's share."""
    fixed, options = region.mask, work.options.refinement
    creases = find_creases(surface)
    mesh = refine_mesh(align_to_creases(mesh, creases, fixed), surface, options, fixed=fixed)
    target = _vertices_wanted(work, tile, mesh.vertices_in_unit, region.fixed)
    if target >= len(mesh.vertices_in_unit):
        return mesh
    mesh = simplify_mesh(mesh, surface, MeshingOptions(vertices=max(target, 4)), fixed=fixed)
    fixed = np.arange(len(mesh.vertices_in_unit)) < region.fixed
    mesh = remesh_anisotropically(mesh, surface, embedded.coordinates, embedded.bases, fixed=at_corners(mesh, creases))
    return refine_mesh(align_to_creases(mesh, creases, fixed), surface, options, fixed=fixed)


def _vertices_wanted(work: Work, tile: int, vertices: NDArray[np.float64], fixed: int) -> int:
    """Return how many vertices a region keeps: all that are fixed, and for the others their share of the particles.

    Where an earlier tile has simplified, each vertex counts as its share.
    """
    plan, before = work.plan, work.folder.load("mesh", 0)["vertices"]
    share = min(SPARE * Agreed.of(work).vertices / len(before), 1.0)
    inside = plan.inside(tile, vertices, plan.collar)
    done = np.zeros(len(vertices), dtype=bool)
    for other in plan.earlier(tile):
        done |= plan.inside(other, vertices, plan.collar)
    shares = np.where(done, 1.0, share)
    particles = int(plan.inside(tile, before, plan.collar).sum())
    rim, beyond = shares[:fixed][inside[:fixed]].sum(), shares[fixed:][~inside[fixed:]].sum()
    return fixed + round(share * particles - float(rim) + float(beyond))


def merge(work: Work, color: int) -> None:
    """Put what the tiles of a colour have finished into the mesh."""
    whole, facts = work.folder.load("mesh", color), work.folder.facts("mesh", color)
    vertices, faces = [whole["vertices"]], whole["faces"]
    kept, added = np.ones(len(faces), dtype=np.int64), [faces[:0]]
    first = len(whole["vertices"])
    for tile in np.flatnonzero(work.plan.colors() == color).tolist():
        made = work.folder.load("finished", tile)
        kept[made["rows"]] -= 1
        fixed, free = made["fixed"], made["vertices"][len(made["fixed"]) :]
        number = np.concatenate([fixed, first + np.arange(len(free))])
        added.append(number[made["faces"]])
        vertices.append(free)
        first += len(free)
    if kept.min(initial=0) < 0:
        raise HdpeaError("Two tiles edited one face.", "This is an error in hdpea: please report it with the input.")
    faces = np.vstack([faces[kept == 1], *added])
    save_mesh(work, color + 1, *drop_unused(np.vstack(vertices), faces), whole["patches"], facts)


def finished_mesh(work: Work) -> Mesh:
    """Return the mesh of all tiles, with no more vertices than are wanted."""
    stage = int(work.plan.colors().max()) + 1
    kept, facts = work.folder.load("mesh", stage), work.folder.facts("mesh", stage)
    vertices, faces = kept["vertices"], kept["faces"]
    budget = _core.MeshBudget()
    budget.vertices = Agreed.of(work).vertices
    nothing = np.empty((0, 3))
    small = _core.simplify_mesh(vertices, vertices, faces, nothing, nothing, budget)
    return Mesh(small.vertices, small.faces, small.coordinates, facts["statistics"], patches=kept["patches"])
