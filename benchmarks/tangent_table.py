# SPDX-License-Identifier: GPL-3.0-or-later
"""Tangent planes in R^8: from which neighbours, and how (the paper's ablation of its section 4).

    python benchmarks/tangent_table.py FOLDER BASELINES [--meshes bull,trex] [--embedding learned] [--picture DIR]

The meshes of FOLDER are sampled (40,000 points) and embedded once; then each row's planes take a cloud through all the
stages that follow. The paper takes PCA over neighbours in R^3; hdpea the plane across the normal, and psi fitted on it.
Scores by the `metrics.py` of BASELINES. Prints Markdown. Needs the `bench` dependency group (`make bench-setup`).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click
import numpy as np
from means_table import print_means
from numpy.typing import NDArray
from side_by_side import draw_side_by_side
from val_table import Sampled, load_metrics, meshes_of

from hdpea import _core
from hdpea.embedding import embed_surface
from hdpea.frame import UnitFrame
from hdpea.meshing import extract_mesh
from hdpea.options import EmbeddingOptions
from hdpea.particles import spread_particles
from hdpea.refinement import refine_mesh
from hdpea.surface import Surface
from hdpea.tangents import TANGENT_NEIGHBORS, tangent_bases

Array = NDArray[np.float64]
COLUMNS = {"T3": 3, "G": 3, "CDs": 3, "HDs": 3, "boundary_edges": 0}


def principal_planes(coordinates: Array, neighbors: NDArray[np.int64]) -> Array:
    """Return bases (n, 2, d): the two directions in which neighbours (n, k) spread most."""
    around = coordinates[np.where(neighbors < 0, np.arange(len(coordinates))[:, None], neighbors)]
    offsets = around - around.mean(axis=1, keepdims=True)
    _, vectors = np.linalg.eigh(np.einsum("nki,nkj->nij", offsets, offsets))
    return np.ascontiguousarray(vectors[:, :, :-3:-1].transpose(0, 2, 1))


PLANES: dict[str, Callable[[Array, Surface], Array]] = {
    "PCA, neighbours in R^8": lambda x, _: principal_planes(x, _core.nearest_neighbors(x, TANGENT_NEIGHBORS)),
    "PCA, neighbours in R^3": lambda x, surface: principal_planes(
        x, _core.nearest_neighbors(surface.points_in_unit, TANGENT_NEIGHBORS)
    ),
    "PCA, neighbours in R^3 of the same sheet": lambda x, surface: principal_planes(
        x, surface.neighbors[:, :TANGENT_NEIGHBORS]
    ),
    "across the normal (hdpea)": lambda x, surface: tangent_bases(x, surface.normals, surface.neighbors),
}


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path))
@click.argument("baselines", type=click.Path(exists=True, path_type=Path))
@click.option("--meshes", help="only these, by name: bull,trex")
@click.option("--vertices", default=5180, show_default=True)
@click.option("--embedding", default=EmbeddingOptions().embedding, show_default=True)
@click.option("--picture", type=click.Path(path_type=Path), help="folder for pictures: rows from left to right")
def main(
    *, folder: Path, baselines: Path, meshes: str | None, vertices: int, embedding: str, picture: Path | None
) -> None:
    """Reconstruct the meshes of FOLDER with each kind of tangent plane."""
    metrics = load_metrics(baselines)
    scores: dict[tuple[str, ...], list[list[float]]] = {}
    for path in meshes_of(folder, meshes):
        sampled = Sampled.of(path, metrics)
        frame = UnitFrame.around(sampled.points)
        surface = Surface.of(frame, frame.to_unit(sampled.points), sampled.normals)
        options = EmbeddingOptions(embedding=embedding)
        coordinates = embed_surface(surface, vertices, options).coordinates
        made = []
        for name, planes in PLANES.items():
            bases = planes(coordinates, surface)
            particles = spread_particles(coordinates, bases, surface.neighbors, vertices)
            mesh = refine_mesh(extract_mesh(particles, bases, surface), surface)
            in_world = frame.to_world(mesh.vertices_in_unit)
            found = metrics.evaluate(in_world, mesh.faces, sampled.truth, sampled.seed)
            found["T3"] = mesh.statistics["t3_kept"] / len(mesh.faces)
            scores.setdefault((name,), []).append([found[column] for column in COLUMNS])
            made.append((in_world, mesh.faces))
        if picture:
            draw_side_by_side(picture / f"{path.stem}.png", made)
        click.echo(path.stem, err=True)
    print_means(["tangent plane"], COLUMNS, scores)


if __name__ == "__main__":
    main()
