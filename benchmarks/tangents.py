# SPDX-License-Identifier: GPL-3.0-or-later
"""Reconstruct with another kind of tangent plane in R^8, as in the HD-PEA paper, section 4.3; run by tangents.toml.

    python benchmarks/tangents.py POINTS MESH VERTICES --planes pca-r3

HD-PEA takes PCA over neighbours in R^3; hdpea the plane orthogonal to the normal, and psi fitted on it.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click
import numpy as np
from given_surface import given_surface
from numpy.typing import NDArray

from hdpea import _core
from hdpea.embedding import embed_surface
from hdpea.embedding.tangents import TANGENT_NEIGHBORS, tangent_bases
from hdpea.mesh.assembly import assemble_mesh
from hdpea.options import EmbeddingOptions, Options, ParticleOptions
from hdpea.surface.surface import Surface
from hdpea.writing.meshes import write_mesh

Array = NDArray[np.float64]


def principal_planes(coordinates: Array, neighbors: NDArray[np.int64]) -> Array:
    """Return bases (n, 2, d): the two directions in which neighbours (n, k) spread most."""
    around = coordinates[np.where(neighbors < 0, np.arange(len(coordinates))[:, None], neighbors)]
    offsets = around - around.mean(axis=1, keepdims=True)
    _, vectors = np.linalg.eigh(np.einsum("nki,nkj->nij", offsets, offsets))
    return np.ascontiguousarray(vectors[:, :, :-3:-1].transpose(0, 2, 1))


PLANES: dict[str, Callable[[Array, Surface], Array]] = {
    "pca-r8": lambda x, _: principal_planes(x, _core.nearest_neighbors(x, TANGENT_NEIGHBORS)),
    "pca-r3": lambda x, surface: principal_planes(
        x, _core.nearest_neighbors(surface.points_in_unit, TANGENT_NEIGHBORS)
    ),
    "pca-sheet": lambda x, surface: principal_planes(x, surface.neighbors[:, :TANGENT_NEIGHBORS]),
    "normal": lambda x, surface: tangent_bases(x, surface.normals, surface.neighbors),
}


@click.command()
@click.argument("points", type=click.Path(exists=True, path_type=Path))
@click.argument("mesh", type=click.Path(path_type=Path))
@click.argument("vertices", type=int)
@click.option("--planes", type=click.Choice(list(PLANES)), required=True)
def main(*, points: Path, mesh: Path, vertices: int, planes: str) -> None:
    """Reconstruct POINTS, which have normals, with one kind of tangent plane."""
    surface = given_surface(points)
    coordinates = embed_surface(surface, vertices, EmbeddingOptions()).coordinates
    bases = PLANES[planes](coordinates, surface)
    made = assemble_mesh(surface, coordinates, bases, Options(particles=ParticleOptions(particles=vertices)))
    write_mesh(mesh, surface.frame.to_world(made.vertices_in_unit), made.faces)


if __name__ == "__main__":
    main()
