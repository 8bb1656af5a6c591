# SPDX-License-Identifier: GPL-3.0-or-later
"""Rounds of the solver that the network saves: starting from the network's psi, and from the normals alone.

    python benchmarks/settling_table.py FOLDER BASELINES [--meshes bull,trex] [--weights FILE]

The meshes of FOLDER are sampled (40,000 points); seconds are those of the embedding alone. Scores by the `metrics.py`
of BASELINES. Prints Markdown. Needs the `bench` dependency group (`make bench-setup`).
"""

from __future__ import annotations

import time
from pathlib import Path

import click
import numpy as np
from means_table import print_means
from numpy.typing import NDArray
from val_table import Sampled, load_metrics, meshes_of

from hdpea.geometry.metric import ScaledMetric
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.network.inference import predict_psi
from hdpea.network.settling import settled
from hdpea.network.weights import SHIPPED, read_weights
from hdpea.surface.surface import Surface, area_shown
from hdpea.training.validation import mesh_of_embedding

COLUMNS = {"T3": 3, "G": 3, "CDs": 3, "HDs": 3, "seconds": 2}
ROUNDS = (0, 1, 2, 4, 8, 25)
NORMAL_FACTOR = 0.2
"""Factor on the normals, in diagonals, where the direct embedding starts."""


def from_normals(surface: Surface, spacing: float, metric: ScaledMetric, rounds: int) -> NDArray[np.float64]:
    """Return psi (n, 5) after so many rounds from where the direct embedding starts."""
    start = np.pad(NORMAL_FACTOR / spacing * surface.normals, ((0, 0), (0, 2)))
    points = surface.points_in_unit / spacing
    return spacing * settled(points, surface.normals, surface.neighbors, start, metric, rounds)


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path))
@click.argument("baselines", type=click.Path(exists=True, path_type=Path))
@click.option("--meshes", help="only these, by name: bull,trex")
@click.option("--vertices", default=5180, show_default=True)
@click.option("--weights", type=click.Path(exists=True, path_type=Path), default=SHIPPED)
def main(*, folder: Path, baselines: Path, meshes: str | None, vertices: int, weights: Path) -> None:
    """Reconstruct the meshes of FOLDER after so many rounds from each start."""
    metrics, network = load_metrics(baselines), read_weights(weights)
    scores: dict[tuple[str, ...], list[list[float]]] = {}
    for path in meshes_of(folder, meshes):
        sampled = Sampled.of(path, metrics)
        frame = UnitFrame.around(sampled.points)
        points = frame.to_unit(sampled.points)
        surface = Surface.of(frame, points, sampled.normals)
        spacing = float(np.sqrt(area_shown(points, surface.neighbors) / vertices))
        for start in ("network", "normals"):
            for rounds in ROUNDS:
                began = time.perf_counter()
                if start == "network":
                    psi = predict_psi(network, points, surface.normals, surface.neighbors, spacing, rounds=rounds)
                else:
                    psi = from_normals(surface, spacing, network.metric, rounds)
                seconds = time.perf_counter() - began
                mesh = mesh_of_embedding(surface, psi, vertices)
                found = metrics.evaluate(frame.to_world(mesh.vertices_in_unit), mesh.faces, sampled.truth, sampled.seed)
                found |= {"T3": mesh.statistics["t3_kept"] / len(mesh.faces), "seconds": seconds}
                scores.setdefault((start, str(rounds)), []).append([found[column] for column in COLUMNS])
        click.echo(path.stem, err=True)
    print_means(["start", "rounds"], COLUMNS, scores)


if __name__ == "__main__":
    main()
