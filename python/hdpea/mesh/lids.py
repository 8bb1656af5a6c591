# SPDX-License-Identifier: GPL-3.0-or-later
"""Lids: patches that close what is open, as the mouths of a pipe, far from all points and across the surface."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.linked import first_linked
from hdpea.geometry.triangles import area_vectors, mesh_area, opposite_faces
from hdpea.mesh.coverage import MIDDLES
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.rims import rims_of
from hdpea.surface.surface import AREA_NEIGHBORS, Surface, areas_shown

EMPTY = 3.0
"""Distance of a patch from the nearest point, in spacings there, from which on nothing can be there but a hole.

Of 21 training meshes, 4,000 points each, 15 have patches where thin parts are torn: most lie within 2.1 spacings of
points, and all that lie 3 off are 1 to 2.2 spacings from the true surface; of 40,000 points of four meshes none lies
2.2 off. The mouths of pipes with 20 points around lie 2.6 to 3.1 off, with 12 around less than 2.2. Of raw scans of
boot, engine, lattice_lamp and anchor, opened patches leave less debris, and rms and wrong side a little smaller."""

LEAST_EMPTY = 0.05
"""Share of the area of a lid that is so far from points, at least.

A tear that winds through a part is so wide in a place or two: a 400th of its area on adis16480. With 0.1 a membrane
of battery_holder_aa stays, which has 0.06, and its HDs are 2.9 instead of 1.2. Of pipes with 20 to 40 points around as
many mouths are open with 0 as with 0.15."""

ACROSS = 0.7
"""Mean cosine of the angle between a patch and the faces around it under which it does not continue the surface: 45
degrees. The hole that an obstacle left in a scan is closed, as the surface goes on behind it."""

MOUTH, SQUARE, FLAT = 1.5, 0.5, 0.7
"""What tells the mouth of a pipe of few points from a tear, if no point near it faces as its patch does: how far from
points this is, in spacings, by how much the faces around it lead away behind it more than they go on, and how flat it
is, by the share of its area that is left seen from ahead.

Of 52 mouths with 10 to 20 points around, 45 are told; of 2,015 patches on 133 closed meshes of 2,000 to 10,000 points
none, but for walls of accessory_holder that 2,000 points tear. Nearest to it, patches of five_torus, man and
column_espresso_cup have 0.42 to 0.5 in place of 0.5, and pipes 0.53 or more, unless they are torn. The points nearest
to a mouth have a cosine of 0.42 at most to its patch; of six ends of 160 closed bars of 150 to 500 points that would be
opened without it, four have 0.92 or more, and two, of bent estimated normals, are."""


def without_lids(mesh: Mesh, surface: Surface) -> Mesh:
    """Open the holes of a mesh again whose patches lie far from all points, across the surface around them.

    A patch that lies square to all that is around it, as on the mouth of a pipe, need not lie as far.

    Its last faces are the patches, ``mesh.patches`` their corners.
    """
    first = len(mesh.faces) - len(mesh.patches)
    empty, nearest = _emptiness(mesh, surface)
    if not (empty > MOUTH).any():
        return mesh
    opposite = opposite_faces(mesh.faces)
    labels = _labels_of_patches(opposite, first)
    vectors = area_vectors(mesh.vertices_in_unit, mesh.faces)
    rims = rims_of(mesh, vectors, opposite, labels)
    areas = np.linalg.norm(vectors[first:], axis=1)
    emptied = np.bincount(labels, areas * (empty > EMPTY), len(areas))
    lids = (emptied > LEAST_EMPTY * rims.areas) & (rims.continued < ACROSS)
    facing = np.einsum("twc,tc->tw", surface.normals[nearest], rims.towards[labels]).max(axis=1)
    farthest, shown = np.zeros(len(areas)), np.full(len(areas), -1.0)
    np.maximum.at(farthest, labels, empty)
    np.maximum.at(shown, labels, facing)
    square = rims.behind - abs(rims.continued) > SQUARE
    lids |= (farthest > MOUTH) & (shown < ACROSS) & square & (rims.flat > FLAT)
    return _without(mesh, lids[labels], int(lids.sum())) if lids.any() else mesh


def _emptiness(mesh: Mesh, surface: Surface) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return how far (k,) each face of the patches is from points, where it is farthest, in spacings there.

    And the points (k, 6) that are nearest to places on it.
    """
    if not len(mesh.patches):
        return np.zeros(0), np.zeros((0, len(MIDDLES)), dtype=np.int64)
    points = surface.points_in_unit
    places = np.einsum("wc,tcx->twx", MIDDLES, mesh.patches)
    nearest = _core.nearest_neighbors(points, places.reshape(-1, 3), 1)[:, 0]
    distances = np.linalg.norm(points[nearest] - places.reshape(-1, 3), axis=1)
    # A point on the rim has its neighbours on one side, and seems to have more area: the least around is the inside's.
    near = surface.neighbors[nearest, :AREA_NEIGHBORS]
    areas = areas_shown(points, surface.neighbors)
    around = np.quantile(np.where(near >= 0, areas[near], areas[nearest, None]), 0.25, axis=1)
    shares = distances / np.sqrt(np.maximum(around, np.finfo(np.float64).tiny))
    return np.asarray(shares.reshape(len(places), -1).max(axis=1)), nearest.reshape(len(places), -1)


def _labels_of_patches(opposite: NDArray[np.int64], first: int) -> NDArray[np.int64]:
    """Return for each face (k,) of the patches, those from the `first` on, the first that hangs together with it."""
    beyond = opposite[first:] - first
    faces, sides = np.nonzero(beyond >= 0)
    return first_linked(len(beyond), faces, beyond[faces, sides])


def _without(mesh: Mesh, dropped: NDArray[np.bool_], holes: int) -> Mesh:
    """Return a mesh without those faces of its patches (k,) that are `dropped`, which closed so many holes."""
    first = len(mesh.faces) - len(mesh.patches)
    opened = mesh.of_faces(np.vstack([mesh.faces[:first], mesh.faces[first:][~dropped]]))
    vertices, faces = opened.vertices_in_unit, opened.faces
    statistics = dict(mesh.statistics)
    statistics["holes_filled"] -= holes
    statistics["holes_left"] += holes
    statistics["faces_joined"] = len(faces)
    statistics["area_filled"] = mesh_area(vertices, faces[first:]) / mesh_area(vertices, faces)
    return replace(opened, statistics=statistics, patches=mesh.patches[~dropped])
