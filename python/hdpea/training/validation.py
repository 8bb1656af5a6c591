# SPDX-License-Identifier: GPL-3.0-or-later
"""What a network is worth: meshes of clouds it has not seen, made from its embedding, and how good they are."""

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
"""What a network is wanted to reach."""


def validate(
    network: PointTransformer, samples: Iterable[tuple[Sample, float]], vertices: int, rounds: int = ROUNDS
) -> dict[str, float]:
    """Return the mean scores of the meshes of so many `vertices` that the network makes of samples and their spacing.

    Parameters
    ----------
    rounds
        Of the solver after the network.

    Returns
    -------
    ``t3``: faces that three cells agree on, as a share of the faces, or of those that a closed mesh of so many
    vertices has, if there are fewer; ``g``: quality under the true metric (1 is best);
    ``boundary``: edges of one face; ``score``: what checkpoints are chosen by, the sum of t3 and g, of which each
    counts only up to a little above what is wanted.
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
        # Small pieces are dropped after the count, and what was dropped is no success.
        "t3": min(mesh.statistics["t3_kept"], len(mesh.faces)) / max(len(mesh.faces), 2 * vertices - 4),
        "g": float(metric_quality(mesh, sample).mean()),
        "boundary": float(check.boundary_edges),
    }


def mesh_of_sample(
    network: PointTransformer, sample: Sample, spacing: float, vertices: int, rounds: int = ROUNDS
) -> Mesh:
    """Return the mesh of so many `vertices` that the network and so many `rounds` of the solver make of a sample."""
    points, normals = np.asarray(sample.points, np.float64), np.asarray(sample.normals, np.float64)
    surface = Surface.of(UnitFrame(np.zeros(3), 1.0), points, normals / np.linalg.norm(normals, axis=1, keepdims=True))
    psi = predict_psi(network, points, surface.normals, surface.neighbors, spacing, rounds=rounds)
    return mesh_of_embedding(surface, psi, vertices)


def mesh_of_embedding(surface: Surface, psi: NDArray[np.float64], vertices: int) -> Mesh:
    """Return the mesh that all stages after the embedding make of a surface of n points and psi (n, 5)."""
    points = len(surface.points_in_unit)
    particles = min(vertices, points)
    coordinates = np.hstack([surface.points_in_unit, psi])
    bases = tangent_bases(coordinates, surface.normals, surface.neighbors, points / particles)
    return assemble_mesh(surface, coordinates, bases, Options(particles=ParticleOptions(particles=particles)))


def metric_quality(mesh: Mesh, sample: Sample) -> NDArray[np.float64]:
    """Return the quality G (f,) of each face under the metric of the true curvature; 1 if equilateral there."""
    points, normals, curvatures, direction1 = (
        np.asarray(each, np.float64)
        for each in (sample.surface_points, sample.normals, sample.curvatures, sample.direction1)
    )
    metric = CurvatureMetric(points, root_metrics(normals, curvatures, direction1))
    return metric.qualities(mesh.vertices_in_unit, mesh.faces)
