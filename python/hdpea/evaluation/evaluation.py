# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluation of a result against the true surface."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.evaluation.curvature_metric import triangle_qualities
from hdpea.evaluation.distances import DirectedDistances, SampleDistances, distances_between, distances_to_surface
from hdpea.evaluation.normalization import NORMALIZATIONS, Normalization
from hdpea.evaluation.scores import (
    DEGENERATE_ANGLE,
    Accuracy,
    Evaluation,
    SampleScores,
    Topology,
    TriangleScores,
)
from hdpea.evaluation.triangle_shapes import triangle_angles
from hdpea.evaluation.truth import Truth, seeds
from hdpea.geometry.sampling import sample_surface

Rows = NDArray[np.float64]

FAR_APART = 0.25
"""Root mean square distance to the truth, in longest sides, from which a wrong frame is suspected."""

WRONG_FRAME = "The result is far from the truth: are both in the same frame and units?"


def evaluate(vertices_in_world: Rows, faces: NDArray[np.int64], truth: Truth) -> Evaluation:
    """Evaluate a mesh, vertices (v, 3) float64 and faces (f, 3) int64, against the truth, in the units of the truth.

    Every vertex must belong to a face. The scores depend only on the mesh, the truth and the options that the truth
    was prepared with. ``docs/evaluation.md`` defines them.

    Raises
    ------
    CannotReconstruct
        If the result has no area.
    """
    vertices = truth.from_world(vertices_in_world)
    with core_errors_translated():
        samples = sample_surface(vertices, faces, truth.options.samples, seed=seeds(truth.options)[-1])
        between = distances_between(truth.points, truth.normals, samples.points, samples.normals)
        corners = truth.points[:0] if truth.surface is None else truth.surface[0]
        to_result = distances_to_surface(truth.points, corners, vertices, faces)
        to_truth = None if truth.surface is None else distances_to_surface(samples.points, vertices, *truth.surface)
        triangles, topology = _triangle_scores(vertices, faces, truth), _topology(vertices, faces)
    units = {"longest_side": 1.0, "diagonal": truth.diagonal}
    accuracy = {
        each.name: _accuracy(units[each.name], each, between, truth.floor, to_result, to_truth)
        for each in NORMALIZATIONS
    }
    in_world = {name: unit * truth.longest_side for name, unit in units.items()}
    kind = "points" if truth.surface is None else "mesh"
    apart = max(each.rms for each in (to_result, to_truth) if each is not None)
    notes = (WRONG_FRAME,) if apart > FAR_APART else ()
    return Evaluation(topology, triangles, accuracy, in_world, kind, len(truth.points), truth.options, notes)


def _accuracy(
    unit: float,
    normalization: Normalization,
    between: SampleDistances,
    floor: SampleDistances | None,
    to_result: DirectedDistances,
    to_truth: DirectedDistances | None,
) -> Accuracy:
    def scores(distances: SampleDistances) -> SampleScores:
        return SampleScores(
            distances.chamfer(unit),
            distances.f1(normalization.f1_threshold * unit),
            distances.normal_consistency,
            distances.hausdorff(unit),
        )

    return Accuracy(
        scores(between),
        None if floor is None else scores(floor),
        to_result.in_unit(unit),
        None if to_truth is None else to_truth.in_unit(unit),
    )


def _triangle_scores(vertices: Rows, faces: NDArray[np.int64], truth: Truth) -> TriangleScores:
    angles = triangle_angles(vertices, faces)
    smallest = angles.min(axis=1)
    return TriangleScores(
        g=None if truth.metric is None else float(truth.metric.qualities(vertices, faces).mean()),
        g_isotropic=float(triangle_qualities(vertices[faces]).mean()),
        degenerate=float(np.mean(smallest < DEGENERATE_ANGLE)),
        smallest_angle=float(smallest.min()),
        mean_smallest_angle=float(smallest.mean()),
        largest_angle=float(angles.max()),
    )


def _topology(vertices: Rows, faces: NDArray[np.int64]) -> Topology:
    check = _core.check_mesh(vertices, faces)
    watertight = check.closed and check.nonmanifold_edges == 0
    return Topology(
        vertices=check.vertices,
        faces=check.faces,
        components=check.components,
        boundary_edges=check.boundary_edges,
        boundary_loops=check.boundary_loops,
        nonmanifold_edges=check.nonmanifold_edges,
        nonmanifold_vertices=check.nonmanifold_vertices,
        self_intersections=_core.count_self_intersections(vertices, faces),
        manifold=check.manifold,
        oriented=check.oriented,
        watertight=watertight,
        genus=check.genus if watertight else None,
    )
