# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be said against a mesh of a raw cloud whose true surface nobody knows."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.cleaning import surface_cloud
from hdpea.geometry.triangles import area_vectors
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import CleaningOptions, DenoisingOptions, NormalOptions
from hdpea.reading import read_points
from hdpea.reading.cleaning import cleaned
from hdpea.surface.preparation import prepare_surface

Array = NDArray[np.float64]

PATCH = 20
"""Faces from which a patch is large enough to be seen."""

NEAREST = 8
"""Points that a face is compared with."""

LONG = 8.0
"""Edges this many times longer than the spacing of the vertices that the points allow, one for every 8 points, belong
to faces across what was not scanned, unless the surface is flat there."""

FAR = 4.0
"""Spacings of the points from which a point is missed, or a face is off."""


@dataclass(frozen=True)
class Known:
    """What is known of a surface: points without strays (n, 3) in the unit frame, and their normals (n, 3)."""

    frame: UnitFrame
    points: Array
    normals: Array
    spacing: float

    @classmethod
    def of(cls, path: Path) -> Known:
        """Read a cloud; its normals are those of the file, or estimated, and oriented as a run does it."""
        cloud = surface_cloud(cleaned(read_points(path)), CleaningOptions()).cloud
        prepared = prepare_surface(cloud, NormalOptions(), DenoisingOptions(denoise="none"), 8.0)
        surface = prepared.oriented.surface
        return cls(surface.frame, surface.points_in_unit, surface.normals, surface.spacing)


@dataclass(frozen=True)
class MeshMeasures:
    """Counts, and shares in percent.

    Attributes
    ----------
    small
        Components of fewer than ``PATCH`` faces.
    wrong, patches
        Share of the area whose normal contradicts those of the nearest points, and how many patches of at least
        ``PATCH`` faces that is. As far as it can be known: the points' own normals may be wrong.
    long
        Share of the area in faces with a long edge whose middle is far from all points.
    missed
        Share of the points that are far from the mesh.
    off
        Share of the area whose middle is far from all points.
    """

    vertices: int
    closed: bool
    components: int
    small: int
    loops: int
    cuts: int
    wrong: float
    patches: int
    long: float
    missed: float
    off: float


def mesh_measures(vertices: Array, faces: NDArray[np.int64], known: Known) -> MeshMeasures:
    """Measure a mesh (v, 3), (f, 3) of the units of the cloud."""
    in_unit = known.frame.to_unit(vertices)
    check = _core.check_mesh(in_unit, faces)
    vectors = area_vectors(in_unit, faces)
    areas = np.linalg.norm(vectors, axis=1)
    middles = in_unit[faces].mean(axis=1)
    nearest = _core.nearest_neighbors(known.points, middles, min(NEAREST, len(known.points)))
    wrong = np.einsum("fc,fkc->f", vectors, known.normals[nearest]) < 0
    off = np.linalg.norm(known.points[nearest[:, 0]] - middles, axis=1) > FAR * known.spacing
    edges = in_unit[faces] - in_unit[np.roll(faces, 1, axis=1)]
    long = np.linalg.norm(edges, axis=2).max(axis=1) > LONG * np.sqrt(8) * known.spacing
    missed = _core.closest_surface_points(in_unit, faces, known.points).distance > FAR * known.spacing

    def percent(chosen: NDArray[np.bool_]) -> float:
        return 100 * float(areas[chosen].sum() / areas.sum())

    return MeshMeasures(
        vertices=len(vertices),
        closed=check.closed,
        components=check.components,
        small=len(patches_of(faces, np.ones(len(faces), bool), 1)) - len(patches_of(faces, np.ones(len(faces), bool))),
        loops=check.boundary_loops,
        cuts=_core.count_self_intersections(in_unit, faces),
        wrong=percent(wrong),
        patches=len(patches_of(faces, wrong)),
        long=percent(long & off),
        missed=100 * float(missed.mean()),
        off=percent(off),
    )


def patches_of(faces: NDArray[np.int64], chosen: NDArray[np.bool_], least: int = PATCH) -> list[NDArray[np.int64]]:
    """Return the rows of the chosen faces in patches that share edges, of at least so many faces."""
    rows = np.flatnonzero(chosen)
    adjacency = trimesh.graph.face_adjacency(faces[rows])
    parts = trimesh.graph.connected_components(adjacency, nodes=np.arange(len(rows)), min_len=least)
    return [rows[part] for part in parts]
