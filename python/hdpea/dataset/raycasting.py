# SPDX-License-Identifier: GPL-3.0-or-later
"""First intersections of rays with a mesh, by Embree."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UsageError


@dataclass(frozen=True)
class Hits:
    """The rays that hit the mesh.

    Attributes
    ----------
    rays, faces
        (h,) int64: indices of the rays, ascending, and the faces they hit first.
    barycentric
        (h, 3) float64: weights of these faces' corners, not negative, sum 1.
    """

    rays: NDArray[np.int64]
    faces: NDArray[np.int64]
    barycentric: NDArray[np.float64]


def require_embree() -> None:
    """Check that rays can be cast.

    Raises
    ------
    UsageError
        If embreex is not installed.
    """
    if find_spec("embreex") is None:
        raise UsageError("Cannot scan: embreex is not installed.", "pip install 'hdpea[dataset]'")


class RayCaster:
    """A mesh (v, 3), (f, 3) in its unit frame, to cast rays at; Embree computes in float32.

    Raises
    ------
    UsageError
        If embreex is not installed.
    """

    def __init__(self, vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
        require_embree()
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self._scene = EmbreeScene(robust=True)  # otherwise a ray may pass between two faces
        TriangleMesh(self._scene, vertices.astype(np.float32), faces.astype(np.int32))

    def cast(self, origin: NDArray[np.float64], directions: NDArray[np.float64]) -> Hits:
        """Cast rays from one origin (3,) in `directions` (r, 3)."""
        origins = np.broadcast_to(origin.astype(np.float32), directions.shape).copy()
        found = self._scene.run(origins, directions.astype(np.float32), query="INTERSECT", output=True)
        rays = np.flatnonzero(found["primID"] >= 0)
        second, third = (found[name][rays].astype(np.float64).clip(0, 1) for name in ("u", "v"))
        third = np.minimum(third, 1 - second)  # by rounding, Embree's weights may lie outside the triangle
        barycentric = np.stack([1 - second - third, second, third], axis=1)
        return Hits(rays, found["primID"][rays].astype(np.int64), barycentric)
