# SPDX-License-Identifier: GPL-3.0-or-later
"""Effect of each option of the ground truth on reconstructions from the true embedding.

    python benchmarks/ground_truth_table.py [--meshes bull,trex] [--save DIR]

Meshes are sampled and scored as `val_table.py` does, and reconstructed by the oracle. Options change one at a time
from the defaults of `GroundTruthOptions`. Prints Markdown. It takes two minutes per mesh, and can be interrupted.
Needs the `bench` dependency group (`make bench-setup`).
"""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import ModuleType

import click
import numpy as np
from keeping import kept
from oracle import oracle_embedder
from val_table import ROOT, Sampled, load_metrics, meshes_of

from hdpea import reconstruct
from hdpea.dataset.options import GroundTruthOptions
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.refinement import refine_mesh
from hdpea.options import MeshingOptions, Options, RefinementOptions
from hdpea.surface.normals import oriented_surface
from hdpea.surface.surface import Surface

MESHES = "adis16480,anchor,boot,bull,engine,goblet_top,lattice_lamp,lewis_queen,trex,ycb_scissors"
"""The five meshes with the worst results of the oracle, and five others."""

VALUES = {
    "metric_scale": (20.0, 80.0),
    "max_stretch": (4.0, 8.0),
    "bending_length": (0.4, 0.9),
    "curvature_radius": (0.8, 1.8),
    "remesh_length": (0.35, 0.75),
}
"""Values beside the default: half and twice the squared stretch, two thirds and three halves of a length."""

DEFAULTS = GroundTruthOptions()

Scores = tuple[float, float, float]


def variants() -> dict[str, GroundTruthOptions]:
    """Return the options to compare, by a label of what differs from the defaults."""
    changed = [(name, value) for name, values in VALUES.items() for value in values]
    return {"defaults": DEFAULTS} | {
        f"{name} {value:g} ({getattr(DEFAULTS, name):g})": replace(DEFAULTS, **{name: value}) for name, value in changed
    }


def scores(
    sampled: Sampled, surface: Surface, options: GroundTruthOptions, vertices: int, metrics: ModuleType
) -> Scores:
    """Return T3, G before the refinement and CDs after it."""
    truth = sampled.truth
    plain = reconstruct(
        sampled.points,
        sampled.normals,
        Options(meshing=MeshingOptions(vertices=vertices), refinement=RefinementOptions(refine=False)),
        embedder=oracle_embedder(truth.V, truth.F, options),
    )
    in_unit = surface.frame.to_unit(plain.vertices)
    refined = refine_mesh(Mesh(in_unit, plain.faces, in_unit), surface)
    before = metrics.evaluate(plain.vertices, plain.faces, truth, sampled.seed)
    after = metrics.evaluate(surface.frame.to_world(refined.vertices_in_unit), plain.faces, truth, sampled.seed)
    return plain.report.meshing["t3_kept"] / plain.report.meshing["faces_joined"], before["G"], after["CDs"]


def run_mesh(path: Path, baselines: Path, vertices: int) -> dict[str, Scores]:
    """Return the scores of one mesh by variant."""
    metrics = load_metrics(baselines)
    sampled = Sampled.of(path, metrics)
    surface = oriented_surface(sampled.points, sampled.normals).surface
    rows = {}
    for name, options in variants().items():
        rows[name] = t3, g, cds = scores(sampled, surface, options, vertices, metrics)
        click.echo(f"{path.stem}, {name}: T3 {t3:.4f}, G {g:.4f}, CDs {cds:.4f}", err=True)
    return rows


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.argument("baselines", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/baselines")
@click.option("--meshes", default=MESHES, show_default=True, help="these, by name")
@click.option("--vertices", default=5180, show_default=True)
@click.option("--jobs", default=2, show_default=True, help="meshes at a time")
@click.option("--save", type=click.Path(path_type=Path), help="folder of stored scores, which are not computed again")
def main(*, folder: Path, baselines: Path, meshes: str, vertices: int, jobs: int, save: Path | None) -> None:
    """Reconstruct meshes of FOLDER from true embeddings by these options; score them by the metrics in BASELINES."""
    paths = meshes_of(folder, meshes)
    with ProcessPoolExecutor(jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        futures = [pool.submit(kept, save, path.stem, partial(run_mesh, path, baselines, vertices)) for path in paths]
        by_mesh = [future.result() for future in futures]
    click.echo(f"Means over {len(paths)} meshes ({', '.join(path.stem for path in paths)}):\n")
    click.echo("| option (its default) | T3, % | G before refinement | CDs | CDs, geometric mean |")
    click.echo("|---|---|---|---|---|")
    for name in variants():
        rows = [of_mesh[name] for of_mesh in by_mesh]
        t3, g, cds = np.mean(rows, axis=0)
        geometric = np.exp(np.log([row[2] for row in rows]).mean())
        click.echo(f"| {name} | {100 * t3:.2f} | {g:.3f} | {cds:.3f} | {geometric:.4f} |")


if __name__ == "__main__":
    main()
