# SPDX-License-Identifier: GPL-3.0-or-later
"""Agreement of the scores of `hdpea evaluate` with an independent implementation, the baselines' `metrics.py`.

    python benchmarks/evaluation_agreement.py [MESHES] [BASELINES]

Each mesh, decimated, is measured against itself by both, with several seeds. A score agrees if the means over the
seeds differ by no more than four times the spread between seeds, or by 2 %. Prints Markdown; exits with 1 if a
score disagrees. Needs the `bench` dependency group and fast-simplification.

HDs, the largest exact distance, is not compared: `metrics.py` takes it over samples only, hdpea over the vertices as
well.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import click
import fast_simplification
import numpy as np
from val_table import ROOT, load_metrics

from hdpea.evaluation import evaluate
from hdpea.evaluation.normalization import DIAGONAL, LONGEST_SIDE
from hdpea.evaluation.options import EvaluationOptions
from hdpea.evaluation.scores import Evaluation
from hdpea.evaluation.truth import truth_of_mesh
from hdpea.geometry.triangles import TriangleMesh
from hdpea.reading.triangle_mesh import read_triangle_mesh

SEEDS = 3
REDUCTION = 0.8
"""Share of the faces that the decimation removes."""

SPREADS, SHARE = 4.0, 0.02


def decimated(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh of fewer faces, without unused vertices."""
    vertices, faces = fast_simplification.simplify(mesh[0].astype(np.float32), mesh[1].astype(np.int32), REDUCTION)
    used, corners = np.unique(faces, return_inverse=True)
    return vertices[used].astype(np.float64), corners.reshape(-1, 3).astype(np.int64)


def ours(evaluation: Evaluation) -> dict[str, float | None]:
    """Return our scores by the names and in the units of `metrics.py`."""
    sides, diagonals = (evaluation.accuracy[each.name] for each in (LONGEST_SIDE, DIAGONAL))
    return {
        "CD": 1e5 * sides.samples.chamfer,
        "F1": sides.samples.f1,
        "NC": sides.samples.normal_consistency,
        "HD": 1e2 * sides.samples.hausdorff,
        "CDd": 1e5 * diagonals.samples.chamfer,
        "F1d": diagonals.samples.f1,
        "HDd": 1e2 * diagonals.samples.hausdorff,
        "CDs": None if sides.chamfer is None else 1e5 * sides.chamfer,
        "G": evaluation.triangles.g,
        "Giso": evaluation.triangles.g_isotropic,
        "degenerate": 100 * evaluation.triangles.degenerate,
        "min_angle": evaluation.triangles.smallest_angle,
        "mean_min_angle": evaluation.triangles.mean_smallest_angle,
        "floor CD": None if sides.floor is None else 1e5 * sides.floor.chamfer,
        "floor F1": None if sides.floor is None else sides.floor.f1,
    }


def pairs_of_scores(path: Path, metrics: ModuleType) -> Iterator[tuple[dict[str, float], dict[str, float | None]]]:
    """Measure one mesh by both, seed by seed."""
    truth = read_triangle_mesh(path)
    vertices, faces = decimated(truth)
    for seed in range(SEEDS):
        # Theirs draws with seed, seed + 1 and so on: steps keep the draws apart.
        theirs = metrics.GroundTruth(*truth, seed=100 * seed)
        scores = metrics.evaluate((vertices - theirs.offset) * theirs.scale, faces, theirs, 100 * seed)
        floor = theirs.floor()
        scores |= {"floor CD": floor["CD"], "floor F1": floor["F1"]}
        yield scores, ours(evaluate(vertices, faces, truth_of_mesh(*truth, EvaluationOptions(seed=seed))))


@click.command()
@click.argument("meshes", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.argument("baselines", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/baselines")
@click.option("--only", help="only these, by name: bull,trex")
def main(*, meshes: Path, baselines: Path, only: str | None) -> None:
    """Compare both on the meshes of MESHES."""
    metrics, agree = load_metrics(baselines), True
    click.echo(
        "| mesh | score | theirs | ours | difference | spread of a seed | agree |\n|---|---|---|---|---|---|---|"
    )
    for path in sorted(path for path in meshes.glob("*.ply") if not only or path.stem in only.split(",")):
        both = list(pairs_of_scores(path, metrics))
        for name in both[0][1]:
            values = np.array([[float(pair[side][name]) for pair in both] for side in (0, 1)])  # type: ignore[arg-type]
            theirs, mine = values.mean(axis=1)
            spread = values.std(axis=1).max()
            fine = abs(mine - theirs) <= max(SPREADS * spread, SHARE * abs(theirs), 1e-9)
            agree &= bool(fine)
            numbers = f"{theirs:.5f} | {mine:.5f} | {mine - theirs:+.5f} | {spread:.5f}"
            click.echo(f"| {path.stem} | {name} | {numbers} | {'yes' if fine else 'NO'} |")
    sys.exit(0 if agree else 1)


if __name__ == "__main__":
    main()
