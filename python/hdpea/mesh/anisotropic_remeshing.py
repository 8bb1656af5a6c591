# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangles that are equilateral in the embedding, after edge collapses, which choose among the edges there are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.mesh.extraction import Mesh, mask_of
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.surface import Surface


def remesh_anisotropically(
    mesh: Mesh,
    surface: Surface,
    coordinates: NDArray[np.float64],
    bases: NDArray[np.float64],
    progress: PhaseCallback | None = None,
    fixed: NDArray[np.bool_] | None = None,
) -> Mesh:
    """Return the mesh with its edges flipped, and its vertices moved along the embedded surface.

    Nothing moves or flips where that would take the mesh farther from the points than it is, or turn a face over; the
    topology and the number of vertices stay (``anisotropic_remeshing.hpp``).

    Parameters
    ----------
    coordinates
        (n, d) float64: the embedding of the points of `surface`.
    bases
        (n, 2, d) float64: its tangent planes, as ``hdpea.embedding.tangents`` makes them.
    fixed
        (v,) vertices that stay where they are; default: none but those on borders.
    """
    with core_errors_translated():
        made = _core.remesh_anisotropically(
            mesh.vertices_in_unit,
            mesh.coordinates,
            mesh.faces,
            coordinates,
            bases.reshape(len(bases), -1),
            surface.normals,
            progress,
            mask_of(fixed),
        )
    return replace(mesh, vertices_in_unit=made.vertices, faces=made.faces, coordinates=made.coordinates)
