# SPDX-License-Identifier: GPL-3.0-or-later
"""Points of a mesh: even by area, or each as far from the others as can be."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.dataset.options import SamplingOptions
from hdpea.errors import CannotReconstruct, core_errors_translated
from hdpea.geometry.triangles import area_vectors

OVERSAMPLING = 4
"""Points by area for every point that farthest-point sampling keeps: 2 leave the spacing less even."""


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
    vertices: NDArray[np.float64], faces: NDArray[np.int64], options: SamplingOptions | None = None
) -> SurfaceSamples:
    """Draw points of the mesh `vertices` (v, 3), `faces` (f, 3), the same for the same seed.

    Faces without area get no points, and of faces with the same corners only the first does. Points by the method
    ``farthest`` come in the order of their choice, so any first part of them is spread out too.

    Raises
    ------
    CannotReconstruct
        If the mesh has no area.
    """
    options = options or SamplingOptions()
    rng = np.random.default_rng(options.seed)
    if options.method == "area":
        return _uniform_by_area(vertices, faces, options.points, rng)
    many = _uniform_by_area(vertices, faces, OVERSAMPLING * options.points, rng)
    with core_errors_translated():
        kept = _core.farthest_point_sampling(many.points, options.points)
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
        raise CannotReconstruct("The mesh has no area.", "Points can be drawn of faces that are more than lines.")
    upto = np.cumsum(areas[candidates])
    drawn = np.searchsorted(upto, rng.random(count) * upto[-1])
    chosen = candidates[np.minimum(drawn, len(candidates) - 1)]  # rounding may step past the last
    root, share = np.sqrt(rng.random(count)), rng.random(count)
    barycentric = np.stack([1 - root, root * (1 - share), root * share], axis=1)
    return SurfaceSamples(points_at(vertices, faces[chosen], barycentric), normals[chosen], chosen, barycentric)
