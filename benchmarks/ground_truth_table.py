# SPDX-License-Identifier: GPL-3.0-or-later
"""What each option of the ground truth is worth to a reconstruction from the true embedding.

    python benchmarks/ground_truth_table.py [--meshes bull,trex]

Meshes are sampled and scored as `val_table.py` does, and reconstructed by the oracle. Options change one at a time,
around the defaults of `GroundTruthOptions`. Prints Markdown. Needs the `bench` dependency group (`make bench-setup`).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import ModuleType

import click
import numpy as np
from oracle import oracle_embedder
from val_table import ROOT, Sampled, load_metrics, meshes_of

from hdpea import reconstruct
from hdpea.dataset.options import GroundTruthOptions
from hdpea.meshing import Mesh
from hdpea.normals import oriented_surface
from hdpea.options import MeshingOptions, Options, RefinementOptions
from hdpea.refinement import refine_mesh
from hdpea.surface import Surface

MESHES = "adis16480,anchor,boot,bull,engine,goblet_top,lattice_lamp,lewis_queen,trex,ycb_scissors"
"""The five that the oracle is worst on, and five others."""

VALUES = {
    "metric_scale": (20.0, 80.0),
    "max_stretch": (4.0, 8.0),
    "bending_length": (0.4, 0.9),
    "curvature_radius": (0.8, 1.8),
    "remesh_length": (0.35, 0.75),
}
"""Values beside the default: half and twice the squared stretch, two thirds and three halves of a length."""

DEFAULTS = GroundTruthOptions()


def variants() -> dict[str, GroundTruthOptions]:
    """Return the options to compare by what is not the default in them."""
    changed = [(name, value) for name, values in VALUES.items() for value in values]
    return {"defaults": DEFAULTS} | {
        f"{name} {value:g} ({getattr(DEFAULTS, name):g})": replace(DEFAULTS, **{name: value}) for name, value in changed
    }


def scores(
    sampled: Sampled, surface: Surface, options: GroundTruthOptions, vertices: int, metrics: ModuleType
) -> tuple[float, float, float]:
    """Return T3, G before the refinement and CDs after it."""
    truth = sampled.truth
    plain = reconstruct(
        sampled.points,
        sampled.normals,
        Options(meshing=MeshingOptions(vertices=vertices), refinement=RefinementOptions(refine=False)),
        embedder=oracle_embedder(truth.V, truth.F, options),
    )
    refined = refine_mesh(Mesh(surface.frame.to_unit(plain.vertices), plain.faces), surface)
    before = metrics.evaluate(plain.vertices, plain.faces, truth, sampled.seed)
    after = metrics.evaluate(surface.frame.to_world(refined.vertices_in_unit), plain.faces, truth, sampled.seed)
    return plain.report.meshing["t3_kept"] / len(plain.faces), before["G"], after["CDs"]


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.argument("baselines", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/baselines")
@click.option("--meshes", default=MESHES, show_default=True, help="these, by name")
@click.option("--vertices", default=5180, show_default=True)
def main(*, folder: Path, baselines: Path, meshes: str, vertices: int) -> None:
    """Reconstruct meshes of FOLDER from true embeddings of all sorts; score them by the metrics in BASELINES."""
    metrics, paths = load_metrics(baselines), meshes_of(folder, meshes)
    table: dict[str, list[tuple[float, float, float]]] = {name: [] for name in variants()}
    for path in paths:
        sampled = Sampled.of(path, metrics)
        surface = oriented_surface(sampled.points, sampled.normals).surface
        for name, options in variants().items():
            table[name].append(scores(sampled, surface, options, vertices, metrics))
            t3, g, cds = table[name][-1]
            click.echo(f"{path.stem}, {name}: T3 {t3:.4f}, G {g:.4f}, CDs {cds:.4f}", err=True)
    click.echo(f"Means over {len(paths)} meshes ({', '.join(path.stem for path in paths)}):\n")
    click.echo("| option (its default) | T3, % | G before refinement | CDs | CDs, geometric mean |")
    click.echo("|---|---|---|---|---|")
    for name, rows in table.items():
        t3, g, cds = np.mean(rows, axis=0)
        geometric = np.exp(np.log([row[2] for row in rows]).mean())
        click.echo(f"| {name} | {100 * t3:.2f} | {g:.3f} | {cds:.3f} | {geometric:.4f} |")


if __name__ == "__main__":
    main()
