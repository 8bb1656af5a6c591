# SPDX-License-Identifier: GPL-3.0-or-later
"""Fitting a mesh to the cloud it was made from."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.mesh.extraction import Mesh, mask_of
from hdpea.options import RefinementOptions
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.surface import Surface


def refine_mesh(
    mesh: Mesh,
    surface: Surface,
    options: RefinementOptions | None = None,
    progress: PhaseCallback | None = None,
    fixed: NDArray[np.bool_] | None = None,
    *,
    within_error: bool = False,
) -> Mesh:
    """Return the mesh with its vertices moved so that the faces run through the points (least squares).

    Faces, and with them manifoldness and topology, stay as they are, and so do `fixed` vertices (v,), if any.
    For a mesh that is to keep within an error, which need not be even, they move more freely.
    """
    options = options or RefinementOptions()
    if not options.refine:
        return mesh
    fit = _core.RefinementOptions.within_error() if within_error else _core.RefinementOptions()
    fit.rounds = options.rounds
    with core_errors_translated():
        vertices = _core.refine_vertices(
            mesh.vertices_in_unit, mesh.faces, surface.points_in_unit, surface.normals, fit, progress, mask_of(fixed)
        )
    return replace(mesh, vertices_in_unit=vertices)
