# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of a tile that need no other: the front end, normals, denoising; and, once sides agree, the embedding."""

from __future__ import annotations

from dataclasses import asdict, replace

import numpy as np
from numpy.typing import NDArray

from hdpea.embedding import embed_surface
from hdpea.frontend.cleaning import surface_cloud
from hdpea.mesh.noise import PER_VERTEX, any_number, missed_by_planes
from hdpea.options.denoising import ROUGH
from hdpea.options.embedding import BENDING_LENGTH, CURVATURE_RADIUS
from hdpea.options.lengths import Length
from hdpea.reading.cleaning import cleaned
from hdpea.surface.preparation import Preparation, prepare_surface
from hdpea.surface.surface import area_shown, areas_shown
from hdpea.tiling.folder import Arrays
from hdpea.tiling.intake import tile_cloud
from hdpea.tiling.work import Agreed, Work, surface_of


def prepare(work: Work, tile: int) -> None:
    """Find the surface of a tile and its halo, with normals that agree within it."""
    plan, options = work.plan, work.options
    cloud = cleaned(tile_cloud(work.folder, plan, tile))
    found = surface_cloud(cloud, options.cleaning)
    cloud = found.in_order_of_space()
    per_vertex = plan.points / options.resolution_of(plan.points)
    prepared = prepare_surface(cloud, options.normals, options.denoising, per_vertex)
    surface, given = prepared.surface, prepared.oriented.surface
    points, points_given = (plan.frame.to_unit(each.frame.to_world(each.points_in_unit)) for each in (surface, given))
    own = plan.inside(tile, points_given)
    own_dropped = plan.inside(tile, plan.frame.to_unit(found.dropped.points))
    area = areas_shown(points, surface.neighbors)
    scale = surface.frame.diagonal / plan.frame.diagonal
    facts = {
        "spacing": surface.spacing * scale,
        "spacing_given": given.spacing * scale,
        "points": int(own.sum()),
        "shown": found.points_shown * float(own.mean()),
        "area": float(area[own].sum()),
        "computed_sides": prepared.oriented.computed_sides,
        "exact": prepared.exact,
        "denoised": prepared.denoised,
        "noise": prepared.oriented.roughness.noise,
        "missed_by_planes": _missed_by_planes(prepared, own, scale) if any_number(options) else [],
        "estimated": round(prepared.oriented.estimated * float(own.mean())),
        "dropped": found.dropped.counts(own_dropped),
        "in_heaps": int(found.dropped.in_heaps[own_dropped].sum()),
        "known": len(points),
        "choices": [asdict(choice) for choice in prepared.choices],
        "missed": list(prepared.missed),
        # Those with numbers would be as many as there are tiles.
        "notes": [note for note in prepared.notes if not any(map(str.isdigit, note))],
    }
    arrays: Arrays = {
        "points": points,
        "given": points_given,
        "normals": surface.normals,
        "neighbors": surface.neighbors.astype(np.int32),
        "own": own,
    }
    work.folder.save("prepared", tile, arrays, facts)


def _missed_by_planes(prepared: Preparation, own: NDArray[np.bool_], scale: float) -> list[float | None]:
    """Return what planes miss of a tile's `own` points (n,), for each of ``PER_VERTEX``, in the frame of the whole.

    Nothing of a tile without noise, which would take its time for nothing.
    """
    if prepared.oriented.roughness.noise <= ROUGH:
        return []
    missed = [missed_by_planes(prepared, each, np.flatnonzero(own)) for each in PER_VERTEX]
    return [None if each is None else each * scale**2 for each in missed]


def embed(work: Work, tile: int) -> None:
    """Embed a tile and its halo in an R^8 of its own, at the scale that all tiles have."""
    agreed, surface = Agreed.of(work), surface_of(work, tile)
    options, spacing = work.options.embedding, agreed.spacing * surface.frame.diagonal
    options = replace(
        options,
        bending_length=options.bending_length or Length(BENDING_LENGTH * spacing),
        curvature_radius=options.curvature_radius or Length(CURVATURE_RADIUS * spacing),
    )
    vertices = max(round(area_shown(surface.points_in_unit, surface.neighbors) / agreed.spacing**2), 4)
    embedded = embed_surface(surface, vertices, options)
    own = work.folder.load("prepared", tile)["own"]
    areas = areas_shown(embedded.coordinates, surface.neighbors)
    facts = {"area": float(areas[own].sum()), "choices": [asdict(choice) for choice in embedded.choices]}
    work.folder.save("embedded", tile, {"coordinates": embedded.coordinates, "areas": areas}, facts)
