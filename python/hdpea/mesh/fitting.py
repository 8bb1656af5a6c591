# SPDX-License-Identifier: GPL-3.0-or-later
"""What a mesh is fitted to, and the steps that bring it there."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.triangles import mesh_area
from hdpea.mesh.anisotropic_remeshing import remesh_anisotropically
from hdpea.mesh.creases import align_to_creases, at_corners
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.reaching import reach_points
from hdpea.mesh.refinement import refine_mesh
from hdpea.mesh.simplification import simplify_mesh
from hdpea.options import MeshingOptions, RefinementOptions
from hdpea.runtime.progress import ProgressCallback, of_phase
from hdpea.surface.surface import MIN_POINTS, Surface

LEFT_OUT = 2.0
"""Distance from the mesh, in spacings of its vertices, from which points do not draw it where pieces were dropped.

They are those of these pieces: of CGAL's hippo1 and hippo2 they drew a spike out of a foot."""


@dataclass(frozen=True)
class FitTarget:
    """Embedded points and their creases, to which meshes are fitted.

    Attributes
    ----------
    surface
        The points and their normals.
    coordinates
        (n, d) float64: their embedding.
    bases
        (n, 2, d) float64: its tangent planes.
    creases
        As ``hdpea.mesh.creases.find_creases`` returns them.
    options
        How meshes are fitted.
    progress
        Hears of the phases refinement, simplification and remeshing.
    within_error
        Whether meshes are to keep within an error, and need not be even.
    """

    surface: Surface
    coordinates: NDArray[np.float64]
    bases: NDArray[np.float64]
    creases: _core.Creases
    options: RefinementOptions
    progress: ProgressCallback | None = None
    within_error: bool = False

    def of_kept_pieces(self, mesh: Mesh, vertices: int) -> FitTarget:
        """Return it without the points of pieces that were dropped from a mesh of so many vertices in the end."""
        if not mesh.statistics.get("dropped_components"):
            return self
        points = self.surface.points_in_unit
        spacing = np.sqrt(mesh_area(mesh.vertices_in_unit, mesh.faces) / vertices)
        distances = _core.closest_surface_points(mesh.vertices_in_unit, mesh.faces, points).distance
        kept = np.flatnonzero(distances <= LEFT_OUT * spacing)
        if not MIN_POINTS <= len(kept) < len(points):
            return self
        surface = Surface.of(self.surface.frame, points[kept], self.surface.normals[kept])
        return replace(self, surface=surface, coordinates=self.coordinates[kept], bases=self.bases[kept])

    def fitted(self, mesh: Mesh) -> Mesh:
        """Return the mesh with edges along the creases and vertices where the points have them."""
        mesh = align_to_creases(mesh, self.creases)
        progress = of_phase(self.progress, "refinement")
        return refine_mesh(mesh, self.surface, self.options, progress, within_error=self.within_error)

    def reached(self, mesh: Mesh, vertices: int) -> Mesh:
        """Return the mesh drawn to points that are far from it, by the spacing of so many vertices."""
        return reach_points(mesh, self.surface, self.coordinates, vertices)

    def simplified(self, mesh: Mesh, wanted: MeshingOptions) -> Mesh:
        """Return the mesh with as few vertices or faces as are wanted."""
        return simplify_mesh(mesh, self.surface, wanted, of_phase(self.progress, "simplification"))

    def remeshed(self, mesh: Mesh) -> Mesh:
        """Return the mesh with its edges and vertices evened out in the embedding, but for those at corners."""
        progress = of_phase(self.progress, "remeshing")
        corners = at_corners(mesh, self.creases)
        return remesh_anisotropically(mesh, self.surface, self.coordinates, self.bases, progress, corners)
