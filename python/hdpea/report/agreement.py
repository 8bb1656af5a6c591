# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a mesh is one of its points at all: how much of either has nothing of the other near."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.error_bound import on_patches
from hdpea.mesh.extraction import Mesh
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.surface.surface import Surface, areas_shown

SAMPLES = 20_000
"""Points of the mesh at which it is looked for points."""

NEAR = 1.5
"""Farthest that counts as near, in spacings of as many vertices as are wanted: 4.2 of the points for each eighth."""

MOST_MISSING = 0.1
"""Share of the points, or of the area, from which a mesh is not what was wanted.

In 294 runs on 63 training meshes and the 20 of validation (4,000 to 40,000 points, with and without normals, noise of 0
to 1 % of the diagonal, 50 to 5,000 vertices, open or watertight), and on raw scans of five of them, the larger share
was 2.5 % once, where horns were lost, and else 0.5 % at most; on three real scans 0.2 %; of wires thinner than their
points are apart, 47 %."""


@dataclass(frozen=True)
class Agreement:
    """How much of a mesh and its points have nothing of the other near.

    Attributes
    ----------
    points_without_mesh
        Share of the points.
    area_without_points
        Share of the mesh's area, of which patches of holes count as covered.
    """

    points_without_mesh: float
    area_without_points: float

    def missed(self) -> Iterator[str]:
        """Yield a sentence for each share that is too large."""
        if self.points_without_mesh > MOST_MISSING:
            yield f"{self.points_without_mesh:.0%} of the points have no mesh near."
        if self.area_without_points > MOST_MISSING:
            yield f"{self.area_without_points:.0%} of the mesh's area has no points near."


def distances_to(mesh: Mesh, surface: Surface) -> NDArray[np.float64]:
    """Return how far each point (n,) of a surface is from the mesh, in the unit frame."""
    return _core.closest_surface_points(mesh.vertices_in_unit, mesh.faces, surface.points_in_unit).distance


def agreement_of(
    mesh: Mesh, surface: Surface, vertices: int, distances: NDArray[np.float64] | None = None
) -> Agreement:
    """Compare a mesh with the surface that it was to show in so many `vertices`.

    What is near depends on the local spacing of the points, and on how many of them there are for each vertex: a mesh
    of few vertices cannot lie as near to its points as one of many. Noise does not count where it was averaged out.

    Parameters
    ----------
    surface
        What was embedded.
    vertices
        How many were wanted.
    distances
        (n,) of its points from the mesh, where they are known.
    """
    points = surface.points_in_unit
    per_vertex = max(len(points) / vertices, POINTS_PER_VERTEX)
    near = NEAR * np.sqrt(per_vertex * areas_shown(points, surface.neighbors))
    far_points = (distances_to(mesh, surface) if distances is None else distances) > near
    if mesh_area(mesh.vertices_in_unit, mesh.faces) == 0:
        return Agreement(float(far_points.mean()), 0.0)
    samples = sample_surface(mesh.vertices_in_unit, mesh.faces, SAMPLES).points
    nearest = _core.nearest_neighbors(points, samples, 1)[:, 0]
    far = np.linalg.norm(samples - points[nearest], axis=1) > near[nearest]
    far[far] = ~on_patches(samples[far], near[nearest[far]], mesh.patches)
    return Agreement(float(far_points.mean()), float(far.mean()))
