# SPDX-License-Identifier: GPL-3.0-or-later
"""Validation of a network: reconstruct clouds it was not trained on from its embedding, and score the meshes."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.dataset.sample import Sample
from hdpea.embedding.tangents import tangent_bases
from hdpea.errors import CannotReconstruct
from hdpea.evaluation.curvature_metric import CurvatureMetric, root_metrics
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.assembly import assemble_mesh
from hdpea.mesh.extraction import Mesh
from hdpea.network.inference import predict_psi
from hdpea.network.settling import ROUNDS
from hdpea.network.transformer import PointTransformer
from hdpea.options import Options, ParticleOptions
from hdpea.surface.surface import Surface

T3_WANTED, G_WANTED = 0.95, 0.77
"""Targets, by which the two parts of the score are scaled."""


def validate(
    network: PointTransformer, samples: Iterable[tuple[Sample, float]], vertices: int, rounds: int = ROUNDS
) -> dict[str, float]:
    """Return the mean scores of meshes of so many `vertices`, reconstructed from samples, each with its spacing.

    Parameters
    ----------
    rounds
        Rounds of the solver after the network.

    Returns
    -------
    ``t3``: faces proposed by all three cells, as a share of the faces, or of the faces of a closed mesh of so many
    vertices if that is more; ``g``: mean quality under the true metric (1 is best); ``boundary``: boundary edges;
    ``score``, by which checkpoints are chosen: the sum of t3 and g relative to their targets, each capped a little
    above its target.
    """
    rows = [_scores(network, sample, spacing, vertices, rounds) for sample, spacing in samples]
    means = {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}
    score = min(means["t3"] / T3_WANTED, 1.02) + min(means["g"] / G_WANTED, 1.1)
    return means | {"score": score}


def _scores(network: PointTransformer, sample: Sample, spacing: float, vertices: int, rounds: int) -> dict[str, float]:
    try:
        mesh = mesh_of_sample(network, sample, spacing, vertices, rounds)
    except CannotReconstruct:
        return {"t3": 0.0, "g": 0.0, "boundary": float("nan")}
    check = _core.check_mesh(mesh.vertices_in_unit, mesh.faces)
    return {
        # Small pieces are dropped after t3 was counted, and must not count.
        "t3": min(mesh.statistics["t3_kept"], len(mesh.faces)) / max(len(mesh.faces), 2 * vertices - 4),
        "g": float(metric_quality(mesh, sample).mean()),
        "boundary": float(check.boundary_edges),
    }


def mesh_of_sample(
    network: PointTransformer, sample: Sample, spacing: float, vertices: int, rounds: int = ROUNDS
) -> Mesh:
    """Reconstruct a sample with so many `vertices` by the network and so many `rounds` of the solver."""
    points, normals = np.asarray(sample.points, np.float64), np.asarray(sample.normals, np.float64)
    surface = Surface.of(UnitFrame(np.zeros(3), 1.0), points, normals / np.linalg.norm(normals, axis=1, keepdims=True))
    psi = predict_psi(network, points, surface.normals, surface.neighbors, spacing, rounds=rounds)
    return mesh_of_embedding(surface, psi, vertices)


def mesh_of_embedding(surface: Surface, psi: NDArray[np.float64], vertices: int) -> Mesh:
    """Return the mesh of a surface of n points embedded by psi (n, 5), with so many `vertices`."""
    points = len(surface.points_in_unit)
    particles = min(vertices, points)
    coordinates = np.hstack([surface.points_in_unit, psi])
    bases = tangent_bases(coordinates, surface.normals, surface.neighbors, points / particles)
    return assemble_mesh(surface, coordinates, bases, Options(particles=ParticleOptions(particles=particles)))


def metric_quality(mesh: Mesh, sample: Sample) -> NDArray[np.float64]:
    """Return the quality G (f,) of each face under the true curvature metric; 1 for a face equilateral under it."""
    points, normals, curvatures, direction1 = (
        np.asarray(each, np.float64)
        for each in (sample.surface_points, sample.normals, sample.curvatures, sample.direction1)
    )
    metric = CurvatureMetric(points, root_metrics(normals, curvatures, direction1))
    return metric.qualities(mesh.vertices_in_unit, mesh.faces)
