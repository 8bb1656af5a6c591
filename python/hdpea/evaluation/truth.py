# SPDX-License-Identifier: GPL-3.0-or-later
"""The true surface, prepared once for the evaluation of any number of results."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import CannotReconstruct, core_errors_translated
from hdpea.evaluation.curvature_metric import SAMPLES, CurvatureMetric, curvature_metric
from hdpea.evaluation.distances import SampleDistances, distances_between
from hdpea.evaluation.options import EvaluationOptions
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.triangles import TriangleMesh, mesh_area
from hdpea.reading import read_points
from hdpea.reading.triangle_mesh import SURFACE_FORMATS, parse_triangle_mesh, read_triangle_mesh

Rows = NDArray[np.float64]


@dataclass(frozen=True)
class Truth:
    """A true surface, or points on one, in a frame centred on its bounding box, whose longest side is 1.

    Attributes
    ----------
    centre_in_world, longest_side
        The frame: (3,) float64, and a length in world units.
    diagonal
        Diagonal of the box, in longest sides: from 1 to sqrt(3).
    points, normals
        (n, 3) float64, on the surface; normals are unit, 0 where unknown, None if all are unknown.
    surface
        The mesh; None if only points are known.
    metric
        The curvature metric; None if the surface is not known.
    floor
        Distances between two samplings of the surface, which no result can undercut; None without a surface.
    options
        How the surface was sampled.
    """

    centre_in_world: Rows
    longest_side: float
    diagonal: float
    points: Rows
    normals: Rows | None
    surface: TriangleMesh | None
    metric: CurvatureMetric | None
    floor: SampleDistances | None
    options: EvaluationOptions

    def from_world(self, points_in_world: Rows) -> Rows:
        """Transform points (n, 3) from world units to this frame."""
        return (points_in_world - self.centre_in_world) / self.longest_side


def seeds(options: EvaluationOptions) -> tuple[int, ...]:
    """Return different seeds for the samples of the truth, of its floor, of its metric, and of results."""
    return tuple(int(each) for each in np.random.SeedSequence(options.seed).generate_state(4))


def truth_of_mesh(vertices_in_world: Rows, faces: NDArray[np.int64], options: EvaluationOptions | None = None) -> Truth:
    """Prepare a mesh as the truth: vertices (v, 3), faces (f, 3), open or closed, every vertex with a face.

    Raises
    ------
    CannotReconstruct
        If it has no area.
    """
    options = options or EvaluationOptions()
    centre, longest, diagonal = _box(vertices_in_world)
    surface = (vertices_in_world - centre) / longest, faces
    of_truth, of_floor, of_metric, _ = seeds(options)
    with core_errors_translated():
        samples, others = (sample_surface(*surface, options.samples, seed=seed) for seed in (of_truth, of_floor))
        shape = sample_surface(*surface, SAMPLES, seed=of_metric)
        metric = curvature_metric(shape.points, shape.normals, mesh_area(*surface))
        floor = distances_between(samples.points, samples.normals, others.points, others.normals)
    return Truth(centre, longest, diagonal, samples.points, samples.normals, surface, metric, floor, options)


def truth_of_points(
    points_in_world: Rows, normals: Rows | None = None, options: EvaluationOptions | None = None
) -> Truth:
    """Prepare noise-free points (n, 3) of a surface as the truth, with unit normals (n, 3), 0 where unknown.

    All points are used, whatever the number of samples. Scores that need the surface between them are unknown: the
    exact distances from the result to the truth, G and the floor.

    Raises
    ------
    CannotReconstruct
        If all points are equal.
    """
    centre, longest, diagonal = _box(points_in_world)
    points = (points_in_world - centre) / longest
    return Truth(centre, longest, diagonal, points, normals, None, None, None, options or EvaluationOptions())


def read_truth(path: Path, options: EvaluationOptions | None = None) -> Truth:
    """Read the truth: a mesh, or else a point cloud in any format that ``hdpea.reading`` knows.

    Raises
    ------
    UnreadableInput
        If it is neither.
    CannotReconstruct
        If it has no extent.
    """
    if path.suffix.lower() in SURFACE_FORMATS and _has_faces(path):
        return truth_of_mesh(*read_triangle_mesh(path), options)
    cloud = read_points(path)
    return truth_of_points(cloud.points, cloud.normals, options)


def _has_faces(path: Path) -> bool:
    return len(parse_triangle_mesh(path)[1]) > 0


def _box(points: Rows) -> tuple[Rows, float, float]:
    """Return the centre of the bounding box, its longest side, and its diagonal in longest sides."""
    low, high = points.min(axis=0), points.max(axis=0)
    longest = float((high - low).max())
    if longest == 0:
        raise CannotReconstruct("All points of the truth are equal.", "A surface is spread out.")
    return low + (high - low) / 2, longest, float(np.linalg.norm(high - low)) / longest
