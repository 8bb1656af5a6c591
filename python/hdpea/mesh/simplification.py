# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh of few vertices from one of many.

Where a few particles would have to show parts thinner than they are apart, their cells do not meet. So a small mesh is
not made of few particles: edges of a finer one are collapsed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.mesh.extraction import Mesh
from hdpea.options import MeshingOptions


def simplify_mesh(mesh: Mesh, options: MeshingOptions, progress: Callable[[float], bool] | None = None) -> Mesh:
    """Return the mesh with edges collapsed until it has no more vertices, or faces, than are wanted.

    The least loss goes first: distance from the surface that was (Garland and Heckbert 1997), and evenness of the
    vertices in the embedding. The topology stays, so that a budget may be out of reach.
    """
    budget = _core.MeshBudget()
    if options.vertices is not None:
        budget.vertices = options.vertices
    if options.faces is not None:
        budget.faces = options.faces
    with core_errors_translated():
        small = _core.simplify_mesh(
            mesh.vertices_in_unit, mesh.coordinates, mesh.faces, budget, _core.SimplificationOptions(), progress
        )
    collapsed = len(mesh.vertices_in_unit) - len(small.vertices)
    return replace(
        mesh,
        vertices_in_unit=small.vertices,
        faces=small.faces,
        coordinates=small.coordinates,
        statistics=mesh.statistics | {"edges_collapsed": collapsed},
    )
