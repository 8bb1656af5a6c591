# SPDX-License-Identifier: GPL-3.0-or-later
"""Reconstruct from the prediction of a network, without the solver after it.

    python benchmarks/network_alone.py POINTS MESH VERTICES --weights FILE

losses.toml uses it to compare networks.
"""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np
from given_surface import given_surface

from hdpea.network.inference import predict_psi
from hdpea.network.weights import read_weights
from hdpea.surface.surface import area_shown
from hdpea.training.validation import mesh_of_embedding
from hdpea.writing.meshes import write_mesh


@click.command()
@click.argument("points", type=click.Path(exists=True, path_type=Path))
@click.argument("mesh", type=click.Path(path_type=Path))
@click.argument("vertices", type=int)
@click.option("--weights", type=click.Path(exists=True, path_type=Path), required=True)
def main(*, points: Path, mesh: Path, vertices: int, weights: Path) -> None:
    """Reconstruct POINTS, which have normals."""
    surface = given_surface(points)
    in_unit = surface.points_in_unit
    spacing = float(np.sqrt(area_shown(in_unit, surface.neighbors) / vertices))
    psi = predict_psi(read_weights(weights), in_unit, surface.normals, surface.neighbors, spacing, rounds=0)
    made = mesh_of_embedding(surface, psi, vertices)
    write_mesh(mesh, surface.frame.to_world(made.vertices_in_unit), made.faces)


if __name__ == "__main__":
    main()
