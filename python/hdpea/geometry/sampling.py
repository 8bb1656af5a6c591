# SPDX-License-Identifier: GPL-3.0-or-later
"""Points drawn from a mesh: uniformly by area, or each as far from the others as possible."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import CannotReconstruct, UsageError, core_errors_translated
from hdpea.geometry.triangles import area_vectors

METHODS = ("area", "farthest")
"""Uniform by area, or each point far from the others."""

OVERSAMPLING = 4
"""Points drawn by area for every point that farthest-point sampling keeps; with 2 the spacing is less even."""


@dataclass(frozen=True)
class SurfaceSamples:
    """Points of a mesh.

    Attributes
    ----------
    points, normals
        (n, 3) float64; the normals are those of the faces, unit, outward where the faces are.
    faces
        (n,) int64: the face each point lies on.
    barycentric
        (n, 3) float64: weights of the face's corners, not negative, sum 1.
    """

    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    faces: NDArray[np.int64]
    barycentric: NDArray[np.float64]


def sample_surface(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], count: int, *, method: str = "area", seed: int = 0
) -> SurfaceSamples:
    """Draw `count` points from the mesh `vertices` (v, 3), `faces` (f, 3), the same for the same seed.

    Faces without area get no points, and of several faces with the same corners only the first does.

    Parameters
    ----------
    method
        ``area``: uniformly at random by area. ``farthest``: farthest-point sampling of four times as many such
        points, in the order in which they are chosen, so that any leading part of them is spread out too.

    Raises
    ------
    UsageError
        If `count` is less than 1, or there is no such method.
    CannotReconstruct
        If the mesh has no area.
    """
    if count < 1 or method not in METHODS:
        raise UsageError(f"Cannot draw {count} points by the method {method!r}.", f"Methods are {', '.join(METHODS)}.")
    rng = np.random.default_rng(seed)
    if method == "area":
        return _uniform_by_area(vertices, faces, count, rng)
    many = _uniform_by_area(vertices, faces, OVERSAMPLING * count, rng)
    with core_errors_translated():
        kept = _core.farthest_point_sampling(many.points, count)
    return SurfaceSamples(many.points[kept], many.normals[kept], many.faces[kept], many.barycentric[kept])


def face_normals(
    vertices: NDArray[np.float64], faces: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the unit normals (f, 3) of the faces, zero for those without area, and their areas (f,)."""
    normals = area_vectors(vertices, faces)
    areas = np.linalg.norm(normals, axis=1)
    return normals / np.where(areas > 0, areas, 1)[:, None], areas


def points_at(
    vertices: NDArray[np.float64], corners: NDArray[np.int64], barycentric: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the points (n, 3) of the triangles with `corners` (n, 3) by their barycentric weights (n, 3)."""
    points: NDArray[np.float64] = np.einsum("nk,nkc->nc", barycentric, vertices[corners])
    return points


def _uniform_by_area(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], count: int, rng: np.random.Generator
) -> SurfaceSamples:
    """Return points uniform by area (Osada et al., Shape Distributions, 2002)."""
    normals, areas = face_normals(vertices, faces)
    _, distinct = np.unique(np.sort(faces, axis=1), axis=0, return_index=True)
    candidates = np.sort(distinct[areas[distinct] > 0])
    if not len(candidates):
        raise CannotReconstruct("The mesh has no area.", "Points are drawn only from faces that are more than lines.")
    upto = np.cumsum(areas[candidates])
    drawn = np.searchsorted(upto, rng.random(count) * upto[-1])
    chosen = candidates[np.minimum(drawn, len(candidates) - 1)]  # rounding may step past the last
    root, share = np.sqrt(rng.random(count)), rng.random(count)
    barycentric = np.stack([1 - root, root * (1 - share), root * share], axis=1)
    return SurfaceSamples(points_at(vertices, faces[chosen], barycentric), normals[chosen], chosen, barycentric)
