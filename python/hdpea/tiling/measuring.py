# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the points of a tile are from the finished mesh, before and after denoising, and the mesh from them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.error_bound import PLACES, ErrorBound
from hdpea.mesh.extraction import Mesh
from hdpea.report.achieved_error import AchievedError
from hdpea.report.agreement import Agreement, agreement_of, distances_to
from hdpea.report.facts import Distances, HeightDifferences
from hdpea.report.heights import height_differences, is_height_field
from hdpea.tiling.work import Agreed, Work, surface_of

BEYOND = 1.5
"""How much of the mesh around its box a tile's points are compared with, in halos: these are on the mesh as well."""

LEAST_PLACES = 5_000
"""Fewest places at which the mesh of a tile is compared with the points: of all tiles as many as of one piece."""


def measure(work: Work, tile: int) -> None:
    """Compare the points of a tile with the mesh around it, and the mesh in its box with the points around that."""
    kept, agreed, surface = work.folder.load("prepared", tile), Agreed.of(work), surface_of(work, tile)
    around, own = (_part_of_mesh(work, tile, beyond) for beyond in (BEYOND * work.plan.halo, 0.0))
    given = replace(surface, points_in_unit=np.ascontiguousarray(kept["given"][kept["own"]]))
    vertices = max(round(len(kept["own"]) / agreed.per_vertex * agreed.vertices / agreed.resolution), 4)
    facts = {
        "points_without_mesh": 1.0,
        "area": mesh_area(own.vertices_in_unit, own.faces),
        "area_without_points": 0.0,
        "mesh_to_points": 0.0,
        # At the rim of a halo points lack neighbours, and are moved where their own tile does not move them.
        "moved": float(np.linalg.norm((kept["points"] - kept["given"])[kept["own"]], axis=1).max(initial=0.0)),
        "points_to_mesh": np.inf if kept["own"].any() else 0.0,
    }
    distances, heights = np.full(len(given.points_in_unit), np.inf), np.full(len(given.points_in_unit), np.nan)
    if len(around.faces):
        distances = distances_to(around, given)
        heights = height_differences(around, given, distances)
        embedded = replace(surface, points_in_unit=np.ascontiguousarray(kept["points"][kept["own"]]))
        moved = work.folder.facts("prepared", tile)["denoised"]
        facts["points_to_mesh"] = float((distances_to(around, embedded) if moved else distances).max(initial=0.0))
        facts["points_without_mesh"] = agreement_of(around, surface, vertices).points_without_mesh
    if len(own.faces):
        facts["area_without_points"] = agreement_of(own, surface, vertices).area_without_points
        places = max(PLACES // work.plan.tiles, LEAST_PLACES)
        facts["mesh_to_points"] = ErrorBound(surface, 0.0).reached(own, places).mesh_to_points
    work.folder.save("measured", tile, {"distances": distances, "heights": heights}, facts)


def _part_of_mesh(work: Work, tile: int, beyond: float) -> Mesh:
    """Return the faces of the finished mesh whose middles lie in a tile, or so far beyond it."""
    whole = work.folder.load("mesh")
    vertices, faces = whole["vertices"], whole["faces"]
    near = work.plan.inside(tile, vertices[faces].mean(axis=1), beyond)
    return Mesh(vertices, faces, vertices, patches=whole["patches"]).of_faces(faces[near])


def measured(work: Work) -> tuple[Distances, Agreement, AchievedError, HeightDifferences | None]:
    """Return what all tiles have measured, in world units; differences in height if the mesh is a height field."""
    tiles, diagonal = range(work.plan.tiles), work.plan.frame.diagonal
    facts = [work.folder.facts("measured", tile) for tile in tiles]
    each = [work.folder.load("measured", tile) for tile in tiles]
    points, area = np.array([len(some["distances"]) for some in each]), np.array([some["area"] for some in facts])
    distances, heights = (np.concatenate([some[name] for some in each]) * diagonal for name in ("distances", "heights"))
    whole = work.folder.load("mesh")
    mesh = Mesh(whole["vertices"], whole["faces"], whole["vertices"])
    along_z = HeightDifferences.of(heights) if is_height_field(mesh) else None
    spacings = [work.folder.facts("prepared", tile)["spacing_given"] for tile in tiles]
    spacing = float(np.average(spacings, weights=points))
    agreement = Agreement(
        float(np.average([some["points_without_mesh"] for some in facts], weights=points)),
        float(np.average([some["area_without_points"] for some in facts], weights=area)),
    )
    farthest = [diagonal * max(some[name] for some in facts) for name in ("points_to_mesh", "mesh_to_points", "moved")]
    error = AchievedError(None, *farthest)
    return Distances.of(distances, spacing * diagonal), agreement, error, along_z
