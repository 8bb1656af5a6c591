# SPDX-License-Identifier: GPL-3.0-or-later
"""From particles to a manifold mesh: restricted Voronoi cells, extraction, holes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import CannotReconstruct, core_errors_translated
from hdpea.geometry.triangles import mesh_area
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.cells import restricted_cells
from hdpea.mesh.coverage import covered
from hdpea.mesh.particles import Particles
from hdpea.options import MeshingOptions
from hdpea.options.choice import Choice
from hdpea.surface.surface import Surface

DISK_RADIUS = 1.8
"""Radius of the disks in mean distances of the particles in R^d."""

HOLES_FILLED = 4.0
"""Size of the largest hole that is filled unasked, in spacings in R^3 of the vertices that the points can show."""


@dataclass(frozen=True)
class Mesh:
    """A triangle mesh in the unit frame.

    Attributes
    ----------
    vertices_in_unit
        (v, 3) float64.
    faces
        (f, 3) int64, counter-clockwise seen from outside; edge- and vertex-manifold.
    coordinates
        (v, d) float64: where the vertices are in the embedding; a fit to the points does not move them there.
    statistics
        Counts of candidate triangles and holes, and the share of the area that fills holes, by name, before any
        simplification.
    choices
        The lengths that were chosen automatically, in world units.
    patches
        (k, 3, 3) float64: the corners of the triangles that close holes, as they were before any fit.
    self_intersections
        Pairs of faces that cut each other, once its repair has counted them.
    """

    vertices_in_unit: NDArray[np.float64]
    faces: NDArray[np.int64]
    coordinates: NDArray[np.float64]
    statistics: dict[str, int | float] = field(default_factory=dict)
    choices: tuple[Choice, ...] = ()
    patches: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3, 3)))
    self_intersections: int | None = None

    def of_faces(self, faces: NDArray[np.int64]) -> Mesh:
        """Return the mesh of these faces (f, 3) only, with the vertices that they use."""
        used, corners = np.unique(faces, return_inverse=True)
        return replace(
            self,
            vertices_in_unit=self.vertices_in_unit[used],
            faces=corners.reshape(-1, 3),
            coordinates=self.coordinates[used],
            self_intersections=None,
        )


def mask_of(vertices: NDArray[np.bool_] | None) -> NDArray[np.bool_]:
    """Return a mask of vertices (v,) as the core takes it: empty if there is none."""
    return np.zeros(0, dtype=bool) if vertices is None else vertices


def extract_mesh(
    particles: Particles,
    bases: NDArray[np.float64],
    surface: Surface,
    options: MeshingOptions | None = None,
    share_kept: float = 1.0,
    resolution: int | None = None,
    *,
    exact: bool = False,
) -> Mesh:
    """Join particles to a mesh.

    Parameters
    ----------
    bases
        (n, 2, d) tangent bases of the cloud.
    surface
        Where the normals come from.
    share_kept
        Share of the vertices that a simplification will keep: pieces that would have too few faces then are dropped.
    resolution
        How many vertices the points can show, by whose spacing it goes which holes are filled, and how far from the
        points a triangle may lie; default: the particles.
    exact
        Whether the points are free of noise, and their normals their own: then these say where a gap that winds through
        both sides of a thin wall is to be closed.

    Raises
    ------
    CannotReconstruct
        If no triangle can be made.
    """
    options = options or MeshingOptions()
    resolution = resolution or len(particles.coordinates)
    with core_errors_translated():
        normals = np.ascontiguousarray(surface.normals[particles.nearest])
        candidates, radii = restricted_cells(particles.coordinates, bases[particles.nearest], DISK_RADIUS)
        on_points = covered(candidates, particles, surface, resolution)
        mesh = join_triangles(
            on_points,
            particles.coordinates,
            normals,
            radii,
            surface.frame,
            options,
            share_kept,
            resolution,
            exact=exact,
        )
        refused = {"refused_uncovered": len(candidates.triangles) - len(on_points.triangles)}
        choices = (smallest_disk(radii, surface.frame), *mesh.choices)
        return replace(mesh, statistics=refused | mesh.statistics, choices=choices)


def smallest_disk(radii: NDArray[np.float64], frame: UnitFrame) -> Choice:
    """Return the radius that was chosen for the disks, as the smallest (m,) of all is."""
    why = f"{DISK_RADIUS:g} mean distances of the particles in the embedding; more where they are sparse"
    return Choice("disk_radius", float(radii.min()) * frame.diagonal, "world units under the metric", why)


def join_triangles(
    candidates: _core.Candidates,
    coordinates: NDArray[np.float64],
    normals: NDArray[np.float64],
    radii: NDArray[np.float64],
    frame: UnitFrame,
    options: MeshingOptions,
    share_kept: float,
    resolution: int,
    *,
    exact: bool = False,
) -> Mesh:
    """Choose a manifold mesh from candidate triangles, and fill its holes.

    Parameters
    ----------
    coordinates
        (m, d) of the particles, positions first, d >= 3.
    normals
        (m, 3) unit, of their points.
    radii
        (m,) of the disks that the cells were cut from, in R^d.
    share_kept, resolution, exact
        As for ``extract_mesh``.

    Raises
    ------
    CannotReconstruct
        If no triangle can be made.
    """
    limits = _core.ExtractionOptions()
    limits.min_component_faces = min(round(options.min_component / share_kept), len(candidates.triangles))
    extracted = _core.extract_manifold(coordinates, normals, radii, candidates, limits)
    if len(extracted.faces) == 0:
        raise CannotReconstruct(
            "No triangle holds on these points.", "They may be too few or too noisy; try fewer `particles`."
        )
    trusted = normals[extracted.sources] if exact else None
    return _fill_holes(coordinates[extracted.sources], trusted, extracted, frame, options, resolution)


def _fill_holes(
    coordinates: NDArray[np.float64],
    normals: NDArray[np.float64] | None,
    extracted: _core.ExtractedMesh,
    frame: UnitFrame,
    options: MeshingOptions,
    resolution: int,
) -> Mesh:
    vertices = np.ascontiguousarray(coordinates[:, :3])
    choices: tuple[Choice, ...] = ()
    if options.watertight:
        size = inf
    elif options.fill_holes is not None:
        size = frame.length_to_unit(options.fill_holes)
    else:
        size = HOLES_FILLED * float(np.sqrt(mesh_area(vertices, extracted.faces) / resolution))
        why = f"{HOLES_FILLED:g} spacings of {resolution:,} vertices"
        choices = (Choice("fill_holes", size * frame.diagonal, "world units", why),)
    filled = _core.fill_holes(vertices, extracted.faces, size)
    nearest = _core.nearest_neighbors(vertices, filled.vertices[len(vertices) :], 1)[:, 0]
    sources = np.concatenate([np.arange(len(vertices)), nearest])  # the centre of a fan is as the vertex nearest to it
    holes_filled = filled.filled
    if filled.left > 0 and normals is not None:
        filled = _core.close_gaps(filled.vertices, filled.faces, normals[sources], size)
        holes_filled += filled.filled
    statistics: dict[str, int | float] = {
        name: getattr(extracted.counts, name) for name in dir(extracted.counts) if not name.startswith("_")
    }
    statistics["holes_filled"] = holes_filled
    statistics["holes_left"] = filled.left
    statistics["faces_joined"] = len(filled.faces)
    closing = filled.faces[len(extracted.faces) :]
    statistics["area_filled"] = mesh_area(filled.vertices, closing) / mesh_area(filled.vertices, filled.faces)
    return Mesh(filled.vertices, filled.faces, coordinates[sources], statistics, choices, filled.vertices[closing])
