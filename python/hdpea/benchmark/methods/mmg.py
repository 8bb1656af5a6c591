# SPDX-License-Identifier: GPL-3.0-or-later
"""Anisotropic remeshing by mmgs (Dapogny et al., 2014), to the curvature metric of the given surface."""

from __future__ import annotations

import mmgpy
import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.benchmark.methods.options import ATTEMPTS, TOLERANCE
from hdpea.evaluation.curvature_metric import SAMPLES, curvature_metric
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.triangles import TriangleMesh, mesh_area
from hdpea.reading.triangle_mesh import drop_unused

GRADATION = 2.3
"""Largest ratio of lengths of adjacent edges; with mmg's default of 1.3, small numbers of vertices are out of reach."""

SHORTEST, LONGEST, ERROR = 1e-4, 2.0, 1.0
"""Limits of edges, in longest sides of the box, and an error bound so large that only the metric counts."""


def adapted(mesh: TriangleMesh, vertices: int) -> TriangleMesh:
    """Return the surface (v, 3), (f, 3) remeshed to about so many vertices.

    The metric is that of G (``hdpea.evaluation.curvature_metric``), of this surface, scaled to the number.
    """
    low, high = mesh[0].min(axis=0), mesh[0].max(axis=0)
    centre, longest = (low + high) / 2, float((high - low).max())
    placed = np.ascontiguousarray((mesh[0] - centre) / longest)
    tensors, area = _metric_at_vertices((placed, mesh[1]))
    asked = vertices
    for _ in range(ATTEMPTS):
        # Each vertex has two equilateral triangles of area 1 / asked under the metric: of this edge, squared.
        squared_edge = 2 / 3**0.5 * area / asked
        remesher = mmgpy.MmgMeshS(placed, mesh[1].astype(np.int32))
        remesher.set_field("tensor", tensors / squared_edge)
        remesher.remesh(hausd=ERROR, hmin=SHORTEST, hmax=LONGEST, hgrad=GRADATION, verbose=-1)
        made, faces = drop_unused(
            np.asarray(remesher.get_vertices(), np.float64), np.asarray(remesher.get_triangles(), np.int64)
        )
        ratio = vertices / len(made)
        if abs(ratio - 1) <= TOLERANCE:
            break
        asked = max(round(asked * ratio), 4)
    return made * longest + centre, faces


def _metric_at_vertices(surface: TriangleMesh) -> tuple[NDArray[np.float64], float]:
    """Return the tensors (v, 6), xx, xy, xz, yy, yz and zz, and the area of the surface under them."""
    drawn = sample_surface(*surface, SAMPLES)
    metric = curvature_metric(drawn.points, drawn.normals, mesh_area(*surface))
    roots = metric.roots[_core.nearest_neighbors(metric.points, surface[0], 1)[:, 0]]
    # The stretch along the normal equals the smaller tangential one, so the two largest scale the area.
    stretches = np.linalg.eigvalsh(metric.roots)[:, 1:].prod(axis=1)
    squares = np.einsum("nij,njk->nik", roots, roots)
    rows, columns = np.triu_indices(3)
    return np.ascontiguousarray(squares[:, rows, columns]), float(stretches.mean()) * mesh_area(*surface)
