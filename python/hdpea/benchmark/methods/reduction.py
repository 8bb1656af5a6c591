# SPDX-License-Identifier: GPL-3.0-or-later
"""Reduction of meshes to fewer vertices, by common libraries."""

from __future__ import annotations

import warnings

import numpy as np

from hdpea.benchmark.methods.options import ATTEMPTS, TOLERANCE
from hdpea.geometry.triangles import TriangleMesh
from hdpea.reading.triangle_mesh import drop_unused

CLUSTERED_FROM = 20
"""Vertices per cluster for pyacvd: a coarser mesh is subdivided first, as its documentation advises."""


def reduced(mesh: TriangleMesh, vertices: int, method: str) -> TriangleMesh:
    """Return a mesh of about so many vertices; the given one if it has fewer, or `method` is ``none``."""
    mesh = drop_unused(*mesh)
    if method == "none" or len(mesh[0]) <= vertices:
        return mesh
    if method == "mmg":
        from hdpea.benchmark.methods.mmg import adapted

        return drop_unused(*adapted(mesh, vertices))
    asked = vertices
    for _ in range(ATTEMPTS):
        made = drop_unused(*_REDUCTIONS[method](mesh, asked))
        ratio = vertices / len(made[0])
        if abs(ratio - 1) <= TOLERANCE:
            break
        asked = max(round(asked * ratio), 4)
    return made


def _collapsed_fast(mesh: TriangleMesh, vertices: int) -> TriangleMesh:
    import fast_simplification

    made = fast_simplification.simplify(
        mesh[0].astype(np.float32), mesh[1].astype(np.int32), target_count=_faces_of(vertices)
    )
    return np.asarray(made[0], np.float64), np.asarray(made[1], np.int64)


def _collapsed_by_meshlab(mesh: TriangleMesh, vertices: int) -> TriangleMesh:
    from hdpea.benchmark.methods.meshlab import current_mesh, with_mesh

    document = with_mesh(mesh)
    document.meshing_decimation_quadric_edge_collapse(targetfacenum=_faces_of(vertices))
    return current_mesh(document)


def _clustered(mesh: TriangleMesh, vertices: int) -> TriangleMesh:
    import pyacvd
    import pyvista

    with warnings.catch_warnings():
        # It uses deprecated parts of pyvista.
        warnings.simplefilter("ignore")
        clusters = pyacvd.Clustering(pyvista.PolyData.from_regular_faces(mesh[0], mesh[1].astype(int)))
        if len(mesh[0]) < CLUSTERED_FROM * vertices:
            clusters.subdivide(2)
        clusters.cluster(vertices)
        made = clusters.create_mesh()
        return np.asarray(made.points, np.float64), np.asarray(made.regular_faces, np.int64)


def _remeshed(mesh: TriangleMesh, vertices: int) -> TriangleMesh:
    from hdpea.benchmark.methods.geogram import remeshed

    return remeshed(mesh, vertices)


def _faces_of(vertices: int) -> int:
    """Return the number of faces of a closed mesh of genus 0 with so many vertices."""
    return 2 * vertices - 4


_REDUCTIONS = {
    "fast": _collapsed_fast,
    "quadric": _collapsed_by_meshlab,
    "acvd": _clustered,
    "cvt": _remeshed,
}
