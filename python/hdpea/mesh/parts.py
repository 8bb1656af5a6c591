# SPDX-License-Identifier: GPL-3.0-or-later
"""From a prepared surface to its mesh: at once, or dense parts of a large scene by themselves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea.embedding import Embedder, embed_surface
from hdpea.embedding.tangents import tangent_bases
from hdpea.geometry.thinning import rows_without
from hdpea.geometry.triangles import mesh_area
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.assembly import assemble_mesh
from hdpea.mesh.extraction import Mesh
from hdpea.options import Length, Options
from hdpea.options.choice import Choice
from hdpea.options.points_shown import PointsShown
from hdpea.runtime.clock import StageClock
from hdpea.runtime.progress import ProgressCallback
from hdpea.surface.surface import Surface

FEWEST = 12
"""Vertices, or faces, that a part is given at least."""


def mesh_surface(
    surface: Surface,
    options: Options,
    shown: PointsShown,
    parts: tuple[NDArray[np.int64], ...],
    progress: ProgressCallback | None,
    clock: StageClock,
    embedder: Embedder | None,
) -> tuple[Mesh, tuple[Choice, ...]]:
    """Embed a surface and mesh it.

    Vertices are spread by area, and detail is told by one length for all. So what was sampled far more densely than
    the scene that it lies in is meshed by itself, with a share of the vertices as large as that of its points. Under an
    error bound this needs no telling: all is meshed at once.

    Parameters
    ----------
    shown
        What the points can show: what the numbers of vertices and particles go by.
    parts
        Rows of each, as ``hdpea.surface.dense_parts`` finds them.

    Returns
    -------
    mesh
        In the frame of the surface.
    choices
        What was chosen automatically; of parts, for what is left of the scene.
    """

    def made_of(part: Surface, budget: Options, shown: PointsShown) -> tuple[Mesh, tuple[Choice, ...]]:
        resolution = budget.resolution_of(shown.count)
        with clock.stage("embedding"):
            embedded = embed_surface(part, resolution, budget.embedding, progress, embedder)
            per_vertex = len(part.points_in_unit) / resolution
            bases = tangent_bases(embedded.coordinates, part.normals, part.neighbors, per_vertex)
        mesh = assemble_mesh(part, embedded.coordinates, bases, budget, progress, clock, shown)
        return mesh, embedded.choices

    if not parts or options.meshing.error is not None:
        return made_of(surface, options, shown)
    rest = rows_without(len(surface.points_in_unit), *parts)
    made = list[tuple[Mesh, UnitFrame, tuple[Choice, ...]]]()
    for rows in (rest, *parts):
        part, share = _part_of(surface, rows), len(rows) / len(surface.points_in_unit)
        budget = _budget_of(options, share, surface.frame.diagonal)
        mesh, choices = made_of(part, budget, shown.of_share(share))
        made.append((mesh, part.frame, choices))
    why = "sampled far more densely than the scene that they lie in: each is meshed by itself"
    joined = _joined([mesh for mesh, _, _ in made], [frame for _, frame, _ in made], surface.frame)
    return joined, (Choice("dense_parts", len(parts), "", why), *made[0][2])


def _part_of(surface: Surface, rows: NDArray[np.int64]) -> Surface:
    """Return the part of a surface that has these rows (m,), in a frame of its own."""
    points = surface.frame.to_world(surface.points_in_unit[rows])
    frame = UnitFrame.around(points)
    return Surface.of(frame, frame.to_unit(points), surface.normals[rows])


def _budget_of(options: Options, share: float, diagonal: float) -> Options:
    """Return the options for a part with this share of the points.

    They ask for its share of every number, and have lengths in world units: percentages are of the `diagonal` of all.
    """

    def number(asked: int | None) -> int | None:
        return None if asked is None else max(round(asked * share), FEWEST)

    def length(given: Length | None) -> Length | None:
        return None if given is None else Length(given.resolve(diagonal))

    meshing, embedding = options.meshing, options.embedding
    return replace(
        options,
        meshing=replace(
            meshing,
            vertices=number(meshing.vertices),
            faces=number(meshing.faces),
            fill_holes=length(meshing.fill_holes),
        ),
        particles=replace(options.particles, particles=number(options.particles.particles)),
        embedding=replace(
            embedding,
            curvature_radius=length(embedding.curvature_radius),
            bending_length=length(embedding.bending_length),
        ),
    )


def _joined(meshes: list[Mesh], frames: list[UnitFrame], frame: UnitFrame) -> Mesh:
    """Return meshes, each in its own frame, as one in a frame of all."""

    def moved(rows: NDArray[np.float64], each: UnitFrame) -> NDArray[np.float64]:
        """Return rows (..., d) whose first three columns are positions."""
        flat = rows.reshape(-1, rows.shape[-1])
        positions = frame.to_unit(each.to_world(np.ascontiguousarray(flat[:, :3])))
        return np.hstack([positions, flat[:, 3:] * (each.diagonal / frame.diagonal)]).reshape(rows.shape)

    own = list(zip(meshes, frames, strict=True))
    firsts = np.cumsum([0, *(len(mesh.vertices_in_unit) for mesh in meshes)])
    areas = np.array([mesh_area(mesh.vertices_in_unit, mesh.faces) * each.diagonal**2 for mesh, each in own])
    names = dict.fromkeys(name for mesh in meshes for name in mesh.statistics)
    statistics = {name: sum(mesh.statistics.get(name, 0) for mesh in meshes) for name in names}
    filled = np.array([mesh.statistics.get("area_filled", 0) for mesh in meshes])
    statistics["area_filled"] = float((filled * areas).sum() / areas.sum()) if areas.sum() > 0 else 0.0
    return Mesh(
        np.vstack([moved(mesh.vertices_in_unit, each) for mesh, each in own]),
        np.vstack([mesh.faces + first for mesh, first in zip(meshes, firsts[:-1], strict=True)]),
        np.vstack([moved(mesh.coordinates, each) for mesh, each in own]),
        statistics,
        meshes[0].choices,
        np.concatenate([moved(mesh.patches, each) for mesh, each in own]),
    )
