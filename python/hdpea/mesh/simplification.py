# SPDX-License-Identifier: GPL-3.0-or-later
"""A coarse mesh from a fine one, by edge collapses.

The cells of few particles do not meet on parts thinner than the particles are apart. So a coarse mesh is made by
collapsing edges of a finer one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.mesh.extraction import Mesh, mask_of
from hdpea.options import MeshingOptions
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.surface import Surface


def simplify_mesh(
    mesh: Mesh,
    surface: Surface,
    options: MeshingOptions,
    progress: PhaseCallback | None = None,
    fixed: NDArray[np.bool_] | None = None,
) -> Mesh:
    """Return the mesh with edges collapsed until it has no more vertices, or faces, than are wanted.

    The cheapest edge goes first; its cost is the squared distance from the tangent planes of the points that it stands
    for (Garland and Heckbert 1997) and the loss of evenness in the embedding. The topology stays, so that a budget may
    be out of reach. Edges at `fixed` vertices (v,), if any, are not collapsed; the order of the vertices that are left
    stays.
    """
    budget = _core.MeshBudget()
    if options.vertices is not None:
        budget.vertices = options.vertices
    if options.faces is not None:
        budget.faces = options.faces
    with core_errors_translated():
        small = _core.simplify_mesh(
            mesh.vertices_in_unit,
            mesh.coordinates,
            mesh.faces,
            surface.points_in_unit,
            surface.normals,
            budget,
            progress,
            mask_of(fixed),
        )
    return simplified(mesh, small)


def simplified(mesh: Mesh, small: _core.SimplifiedMesh) -> Mesh:
    """Return the mesh as the core has simplified it, with the number of edges collapsed so far."""
    collapsed = len(mesh.vertices_in_unit) - len(small.vertices) + mesh.statistics.get("edges_collapsed", 0)
    return replace(
        mesh,
        vertices_in_unit=small.vertices,
        faces=small.faces,
        coordinates=small.coordinates,
        statistics=mesh.statistics | {"edges_collapsed": collapsed},
    )
