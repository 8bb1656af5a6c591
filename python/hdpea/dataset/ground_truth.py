# SPDX-License-Identifier: GPL-3.0-or-later
"""The true embedding and curvature of a mesh, and of any points on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.dataset.options import GroundTruthOptions
from hdpea.errors import CannotReconstruct, core_errors_translated
from hdpea.geometry.directions import directions_of
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.tensors import principal, symmetric_tensors, tangent_directions
from hdpea.geometry.triangles import area_vectors, mesh_area
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.runtime.progress import ProgressCallback, of_phase, tell

CURVATURE_SAMPLES = 100_000
"""Points of the surface to whose normals curvature is fitted."""

CURVATURE_NEIGHBORS = 100
"""Nearest of them considered around each vertex: enough to find all within the radius on the same sheet."""

LEAST_AREA = 1e-9
"""Smallest area of a surface in the unit frame: less is a line up to rounding, which cannot be remeshed."""


@dataclass(frozen=True)
class PointTruth:
    """The truth at points of a surface: psi (n, 5), curvatures (n, 2), direction1 (n, 3), as in ``Sample``."""

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
        """Return the truth at the points of the surface nearest to `points_in_unit` (n, 3).

        Everything is interpolated with the barycentric weights of the nearest point (HD-PEA paper, section 3.1);
        curvature as the shape operator, a tensor, since the sign of a direction is arbitrary.
        """
        with core_errors_translated():
            nearest = _core.closest_surface_points(self.vertices, self.faces, points_in_unit)
        corners, weights = self.faces[nearest.face], nearest.barycentric
        shape_operators = np.einsum("nc,ncij->nij", weights, self._shape_operators()[corners])
        curvatures, direction1 = principal(shape_operators)
        return PointTruth(np.einsum("nc,nci->ni", weights, self.psi[corners]), curvatures, direction1)

    def _shape_operators(self) -> NDArray[np.float64]:
        return symmetric_tensors(self.curvatures, tangent_directions(self.normals, self.direction1))


def embed_mesh(
    vertices_in_world: NDArray[np.float64],
    faces: NDArray[np.int64],
    options: GroundTruthOptions | None = None,
    progress: ProgressCallback | None = None,
) -> EmbeddedMesh:
    """Embed an edge-manifold, oriented triangle mesh (v, 3), (f, 3), closed or with borders, in R^8.

    The mesh is remeshed, since the solver needs better triangles than CAD models have; curvature is fitted, within
    a fixed radius, to the normals of the *given* mesh. Lengths scale with the area (``GroundTruthOptions``).

    Raises
    ------
    UsageError
        If the mesh is not edge-manifold and oriented.
    CannotReconstruct
        If it has no extent, or no area.
    """
    options = options or GroundTruthOptions()
    frame = UnitFrame.around(vertices_in_world)
    given = frame.to_unit(vertices_in_world)
    total = mesh_area(given, faces)
    if total < LEAST_AREA:
        raise CannotReconstruct("The mesh has no area.", "Its faces are degenerate.")
    spacing = float(np.sqrt(total / options.vertices))
    metric = options.metric.at(spacing)
    remeshing = _core.RemeshingOptions()
    remeshing.edge_length = options.remesh_length * spacing
    with core_errors_translated():
        tell(progress, "remeshing", 0)
        mesh = _core.remesh_isotropically(given, faces, remeshing)
        normals = vertex_normals(mesh.vertices, mesh.faces)
        tell(progress, "curvature", 0)
        curvature = _curvature_at(mesh.vertices, normals, given, faces, metric.curvature_radius)
        whole = np.ones(len(mesh.faces))
        phase = of_phase(progress, "embedding")
        psi = _core.solve_embedding(mesh.vertices, normals, curvature, mesh.faces, whole, metric.solver(), phase)
    return EmbeddedMesh(mesh.vertices, mesh.faces, normals, psi, curvature.principal, curvature.direction1, frame)


def _curvature_at(
    vertices: NDArray[np.float64],
    normals: NDArray[np.float64],
    given: NDArray[np.float64],
    faces: NDArray[np.int64],
    radius: float,
) -> _core.Curvature:
    """Fit the curvature at `vertices` to samples of the given mesh, whose normals are exact."""
    samples = sample_surface(given, faces, CURVATURE_SAMPLES)
    points = np.vstack([vertices, samples.points])
    all_normals = np.vstack([normals, samples.normals])
    nearest = len(vertices) + _core.nearest_neighbors(samples.points, vertices, CURVATURE_NEIGHBORS)
    of_samples = np.full((len(samples.points), CURVATURE_NEIGHBORS), -1)
    sheets = _core.sheet_neighbors(points, all_normals, np.vstack([nearest, of_samples]))
    curvature = _core.estimate_curvature(points, all_normals, sheets, radius)
    curvature.principal = curvature.principal[: len(vertices)]
    curvature.direction1 = curvature.direction1[: len(vertices)]
    return curvature


def vertex_normals(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return unit normals (v, 3) of a mesh's vertices, the area-weighted mean of those of their faces."""
    sums, by_area = np.zeros_like(vertices), area_vectors(vertices, faces)
    for corner in range(3):
        np.add.at(sums, faces[:, corner], by_area)
    return directions_of(sums, otherwise=np.eye(3)[2])
