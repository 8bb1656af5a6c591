# SPDX-License-Identifier: GPL-3.0-or-later
"""Small meshes: simplified from as many particles as the points support, or from as many particles as vertices.

    python benchmarks/particles_table.py FOLDER BASELINES [--meshes bull,trex] [--vertices 500,1500,4000]

The meshes of FOLDER are sampled (40,000 points with normals). Scores by the `metrics.py` of BASELINES. Prints Markdown.
Needs the `bench` dependency group (`make bench-setup`).
"""

from __future__ import annotations

from pathlib import Path

import click
from means_table import print_means
from val_table import Sampled, load_metrics, meshes_of

from hdpea import reconstruct
from hdpea.options import MeshingOptions, Options, ParticleOptions

COLUMNS = {"CDs": 3, "HDs": 3, "G": 3, "watertight": 2}


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path))
@click.argument("baselines", type=click.Path(exists=True, path_type=Path))
@click.option("--meshes", help="only these, by name: bull,trex")
@click.option("--vertices", default="500,1500,4000", show_default=True)
def main(*, folder: Path, baselines: Path, meshes: str | None, vertices: str) -> None:
    """Reconstruct the meshes of FOLDER with so many vertices by both methods."""
    metrics = load_metrics(baselines)
    scores: dict[tuple[str, ...], list[list[float]]] = {}
    for path in meshes_of(folder, meshes):
        sampled = Sampled.of(path, metrics)
        for wanted in map(int, vertices.split(",")):
            for name, particles in ("as many as vertices", wanted), ("what the points can show", None):
                options = Options(
                    meshing=MeshingOptions(vertices=wanted), particles=ParticleOptions(particles=particles)
                )
                made = reconstruct(sampled.points, sampled.normals, options)
                found = metrics.evaluate(made.vertices, made.faces, sampled.truth, sampled.seed)
                scores.setdefault((f"{wanted:,}", name), []).append([found[column] for column in COLUMNS])
        click.echo(path.stem, err=True)
    print_means(["vertices", "particles"], COLUMNS, scores)


if __name__ == "__main__":
    main()
