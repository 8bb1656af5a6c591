# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams between the patches of a large cloud (PMEI), compared with the same cloud embedded as a whole.

    python benchmarks/seam_table.py MESH WEIGHTS [--points 250000]

Distances in R^8 to the 12 nearest of the same sheet are compared with the true ones, those of the true embedding of
MESH at the scale of the mesh to come: across the borders of patches, and inside of them. The seam is the ratio of
the errors across and inside: 1 if seams cannot be detected. Prints Markdown.
"""

from __future__ import annotations

import resource
import time
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray
from val_table import read_mesh

from hdpea.dataset.ground_truth import embed_mesh
from hdpea.dataset.options import GroundTruthOptions
from hdpea.geometry.sampling import sample_surface
from hdpea.network.inference import PATCH_POINTS, canonical_order, predict_psi
from hdpea.network.patches import cut_patches
from hdpea.network.weights import read_weights
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.surface.surface import Surface, area_shown

Array = NDArray[np.float64]
NEAREST = 12


def distances(surface: Surface, psi: Array) -> Array:
    """Return distances (n, 12) in R^8 to the nearest of the same sheet; 0 where there is none."""
    neighbors = surface.neighbors[:, :NEAREST]
    coordinates = np.hstack([surface.points_in_unit, psi])
    found = np.linalg.norm(coordinates[neighbors] - coordinates[:, None], axis=2)
    return np.where(neighbors < 0, 0, found)


def across_borders(surface: Surface) -> NDArray[np.bool_]:
    """Return which pairs (n, 12) of neighbours are not in the same patches."""
    order = canonical_order(surface.points_in_unit)
    _, patches = cut_patches(surface.points_in_unit[order], PATCH_POINTS)
    # Points of the same patches have the same sum of the patches' random numbers.
    sums = np.zeros(len(order))
    for number, patch in zip(np.random.default_rng(0).random(len(patches)), patches, strict=True):
        sums[order[patch.members]] += number
    neighbors = surface.neighbors[:, :NEAREST]
    return (sums[neighbors] != sums[:, None]) & (neighbors >= 0)


def relative_errors(found: Array, true: Array, across: NDArray[np.bool_]) -> tuple[float, float]:
    """Return the mean error over the mean true distance, across borders and inside."""
    inside = ~across & (true > 0)
    errors = np.abs(found - true)
    return tuple(float(errors[which].sum() / true[which].sum()) for which in (across, inside))  # type: ignore[return-value]


@click.command()
@click.argument("mesh", type=click.Path(exists=True, path_type=Path))
@click.argument("weights", type=click.Path(exists=True, path_type=Path))
@click.option("--points", default=250_000, show_default=True)
def main(*, mesh: Path, weights: Path, points: int) -> None:
    """Compare embeddings of points of MESH, in patches and as a whole, with the truth."""
    vertices, faces = read_mesh(mesh)
    truth = embed_mesh(vertices, faces, GroundTruthOptions(vertices=points // POINTS_PER_VERTEX))
    samples = sample_surface(truth.frame.to_unit(vertices), faces, points)
    surface = Surface.of(truth.frame, samples.points, samples.normals)
    true = distances(surface, truth.at(samples.points).psi)
    area = area_shown(samples.points, surface.neighbors)
    spacing = float(np.sqrt(area * POINTS_PER_VERTEX / points))
    network = read_weights(weights)
    across = across_borders(surface)
    click.echo(f"{mesh.stem}, {points:,} points, {across.mean():.1%} of the pairs across borders\n")
    click.echo("| embedded | error across | error inside | seam | seconds | peak memory, MB |")
    click.echo("|---|---|---|---|---|---|")
    # The peak memory never falls, so the method that needs less goes first.
    for name, whole_points in (("in patches", 1), ("at once", points)):
        start = time.perf_counter()
        psi = predict_psi(network, surface.points_in_unit, surface.normals, surface.neighbors, spacing, whole_points)
        seconds, peak = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000
        worst, usual = relative_errors(distances(surface, psi), true, across)
        click.echo(f"| {name} | {worst:.3f} | {usual:.3f} | {worst / usual:.2f} | {seconds:.1f} | {peak:.0f} |")


if __name__ == "__main__":
    main()
