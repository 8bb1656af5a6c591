# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes made by the whole pipeline, each made once however many tests look at it."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from helpers import clouds
from numpy.typing import NDArray

from hdpea import Reconstruction, reconstruct
from hdpea.options import MeshingOptions, Options, RefinementOptions

POINTS, VERTICES = 3000, 400


def options(vertices: int | None = VERTICES, refine: bool = True, threads: int = 0, **meshing: Any) -> Options:
    return Options(
        meshing=MeshingOptions(vertices=vertices, **meshing),
        refinement=RefinementOptions(refine=refine),
        threads=threads,
    )


def cloud_of(shape: str, count: int = POINTS) -> clouds.Cloud:
    return (clouds.CLOSED.get(shape) or getattr(clouds, shape))(count)


@cache
def mesh_of(shape: str, **chosen: Any) -> Reconstruction:
    return reconstruct(*cloud_of(shape), options(**chosen))


def assert_same_bytes(one: Reconstruction, other: Reconstruction) -> None:
    np.testing.assert_array_equal(one.faces, other.faces)
    assert one.vertices.tobytes() == other.vertices.tobytes()


def area_vectors(mesh: Reconstruction) -> clouds.Array:
    """Return the normals of the faces, as long as their areas (f, 3)."""
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    return np.cross(b - a, c - a) / 2


def volume(mesh: Reconstruction) -> float:
    """Return the volume that a closed mesh encloses; negative if it is inside out."""
    return float(np.einsum("fc,fc->", area_vectors(mesh), mesh.vertices[mesh.faces[:, 0]]) / 3)


def edges(faces: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the directed edges (3 f, 2)."""
    return np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])


def euler_characteristic(mesh: Reconstruction) -> int:
    undirected = np.unique(np.sort(edges(mesh.faces), axis=1), axis=0)
    return len(np.unique(mesh.faces)) - len(undirected) + len(mesh.faces)
