# SPDX-License-Identifier: GPL-3.0-or-later
"""The true embedding and curvature of a mesh, and of any points on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.options import GroundTruthOptions
from hdpea.frame import UnitFrame
from hdpea.progress import ProgressCallback


@dataclass(frozen=True)
class PointTruth:
    """What is true of points of a surface: psi (n, 5), curvatures (n, 2), direction1 (n, 3), as in ``Sample``."""

    psi: NDArray[np.float64]
    curvatures: NDArray[np.float64]
    direction1: NDArray[np.float64]


@dataclass(frozen=True)
class EmbeddedMesh:
    """A surface as near-isotropic triangles in its unit frame, with its embedding and curvature at the vertices.

    Attributes
    ----------
    vertices, faces
        (v, 3) float64 in the unit frame of the given mesh, (f, 3) int64.
    normals
        (v, 3) float64, unit, outward.
    psi, curvatures, direction1
        (v, 5), (v, 2), (v, 3) float64, as in ``Sample``.
    frame
        The unit frame of the given mesh.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    normals: NDArray[np.float64]
    psi: NDArray[np.float64]
    curvatures: NDArray[np.float64]
    direction1: NDArray[np.float64]
    frame: UnitFrame

    def at(self, points_in_unit: NDArray[np.float64]) -> PointTruth:
        """Return what is true at the points of the surface nearest to `points_in_unit` (n, 3), by barycentric weights."""
        raise NotImplementedError


def embed_mesh(
    vertices_in_world: NDArray[np.float64],
    faces: NDArray[np.int64],
    options: GroundTruthOptions | None = None,
    progress: ProgressCallback | None = None,
) -> EmbeddedMesh:
    """Embed a closed, manifold triangle mesh (v, 3), (f, 3) in R^8."""
    raise NotImplementedError
