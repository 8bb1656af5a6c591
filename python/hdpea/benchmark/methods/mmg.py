# SPDX-License-Identifier: GPL-3.0-or-later
"""Anisotropic remeshing by mmgs (Dapogny et al., 2014), which makes a metric of curvature and of a largest error.

It takes that error and not a number of vertices: the error is sought by bisection.
"""

from __future__ import annotations

import mmgpy
import numpy as np

from hdpea.benchmark.methods.options import TOLERANCE
from hdpea.reading.triangle_mesh import TriangleMesh, drop_unused

ERRORS = (1e-5, 0.1)
"""Errors, in diagonals, between which the one for the wanted number of vertices is sought."""

ATTEMPTS = 10

SHORTEST = 1e-3
"""Edge, in diagonals."""


def adapted(mesh: TriangleMesh, vertices: int) -> TriangleMesh:
    """Return the surface (v, 3), (f, 3) remeshed to about so many vertices, by the metric of its own curvature."""
    diagonal = float(np.linalg.norm(np.ptp(mesh[0], axis=0)))
    low, high = (np.log(each) for each in ERRORS)
    made = mesh
    for _ in range(ATTEMPTS):
        error = float(np.exp((low + high) / 2))
        remesher = mmgpy.MmgMeshS(mesh[0], mesh[1].astype(np.int32))
        # Without the limit on how sizes grow from edge to edge: with it, small budgets are out of reach.
        remesher.remesh(hausd=error * diagonal, hmin=SHORTEST * diagonal, hgrad=-1.0, anisosize=1, verbose=-1)
        made = np.asarray(remesher.get_vertices(), np.float64), np.asarray(remesher.get_triangles(), np.int64)
        excess = len(drop_unused(*made)[0]) / vertices - 1
        if abs(excess) <= TOLERANCE:
            break
        low, high = ((low + high) / 2, high) if excess > 0 else (low, (low + high) / 2)
    return made
