# SPDX-License-Identifier: GPL-3.0-or-later
"""Scores on a folder of meshes, next to those of other methods.

    python benchmarks/val_table.py [--meshes bull,trex] [--save DIR --picture] [--embedding learned] [--no-refine]

Each mesh is sampled (40,000 points with normals, seeded by its name), reconstructed from the points alone, and scored
by the `metrics.py` of the baselines' folder, whose `val.csv` has the rows of the other methods. Prints Markdown. A mesh
that fails is reported in its row. Needs the `bench` dependency group (`make bench-setup`).
"""

from __future__ import annotations

import csv
import multiprocessing
import time
import zlib
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import dataclass
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import ModuleType
from typing import Any

import click
import numpy as np
import trimesh
from numpy.typing import NDArray
from references import REFERENCES

from hdpea import _core, reconstruct
from hdpea.options import EmbeddingOptions, MeshingOptions, Options, RefinementOptions
from hdpea.pictures.picture import draw_mesh
from hdpea.writing.meshes import write_mesh

ROOT = Path(__file__).resolve().parent.parent
POINTS = 40_000
OURS, FLOOR = "hdpea", "floor"

# Columns and their digits. CDs, HDs and G distinguish good meshes; CD, F1 and HD are limited by the sampling floor.
COLUMNS = {
    "nV": 0, "CDs": 3, "HDs": 3, "G": 3, "CD": 3, "F1": 4, "NC": 4, "HD": 3, "T3": 3, "watertight": 2, "manifold": 2,
    "boundary_edges": 1, "nonmanifold_edges": 1, "seconds": 1,
}  # fmt: skip

Row = dict[str, Any]


@dataclass(frozen=True)
class Task:
    """One mesh, and what to do with it."""

    path: Path
    baselines: Path
    options: Options
    reference: str | None
    save: Path | None
    picture: bool


def load_metrics(baselines: Path) -> ModuleType:
    """Import the baselines' `metrics.py`."""
    return load_script(baselines / "metrics.py")


def load_script(path: Path) -> ModuleType:
    """Import a script that is in no package."""
    script = ModuleType(path.stem)
    SourceFileLoader(path.stem, str(path)).exec_module(script)
    return script


def read_mesh(path: Path) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Read vertices and faces, equal vertices merged."""
    mesh = trimesh.load(path, process=False)
    vertices, inverse = np.unique(np.asarray(mesh.vertices, float), axis=0, return_inverse=True)
    return vertices, inverse.reshape(-1)[np.asarray(mesh.faces)]


def meshes_of(folder: Path, names: str | None) -> list[Path]:
    """Return the meshes of a folder, or those of these names, joined by commas."""
    paths = sorted(path for path in folder.glob("*.ply") if not names or path.stem in names.split(","))
    if not paths:
        raise click.UsageError(f"no such meshes in {folder}")
    return paths


@dataclass(frozen=True)
class Sampled:
    """A mesh as `metrics.py` holds it, and points of it with their true normals; the seed is made of its name."""

    truth: Any
    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    seed: int

    @classmethod
    def of(cls, path: Path, metrics: ModuleType) -> Sampled:
        """Read a mesh and sample it."""
        seed = zlib.crc32(path.stem.encode()) % 100_000
        truth = metrics.GroundTruth(*read_mesh(path), seed=seed)
        return cls(truth, *metrics.sample(truth.V, truth.F, POINTS, seed), seed)


def run_mesh(task: Task) -> Row:
    """Sample, reconstruct and score one mesh."""
    name, metrics = task.path.stem, load_metrics(task.baselines)
    sampled = Sampled.of(task.path, metrics)
    truth = sampled.truth

    embedder = REFERENCES[task.reference](truth.V, truth.F) if task.reference else None
    start = time.perf_counter()
    result = reconstruct(sampled.points, sampled.normals, task.options, embedder=embedder)
    seconds = time.perf_counter() - start
    if task.save:
        write_mesh(task.save / f"{name}.ply", result.vertices, result.faces)
        if task.picture:
            draw_mesh(task.save / f"{name}.png", result.vertices, result.faces)

    row: Row = {"mesh": name, "target": task.options.meshing.vertices, "peer": OURS, "status": "ok"}
    row |= metrics.evaluate(result.vertices, result.faces, truth, sampled.seed)
    row["manifold"] = int(_core.check_mesh(result.vertices, result.faces).manifold)
    row["T3"] = result.report.meshing["t3_kept"] / result.report.meshing["faces_joined"]
    return row | {"seconds": seconds}


def run_isolated(task: Task) -> Row:
    """Run a mesh in a process of its own, so that a crash or its memory does not affect the others."""
    try:
        with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
            row = pool.submit(run_mesh, task).result()
    except Exception as error:  # noqa: BLE001 an error in one mesh must not stop the others
        note = f"{type(error).__name__}: {error}"
        row = {"mesh": task.path.stem, "peer": OURS, "status": "failed", "note": note}
    click.echo(f"{task.path.stem}: {row.get('note', row['status'])}", err=True)
    return row


def read_rivals(baselines: Path, meshes: list[str]) -> list[Row]:
    """Return the other methods' rows for these meshes, numbers as numbers."""
    words = {"set", "mesh", "peer", "status", "note"}
    with (baselines / "val.csv").open() as file:
        rows = [
            {key: value if key in words or not value else float(value) for key, value in row.items()}
            for row in csv.DictReader(file)
        ]
    return [row for row in rows if row["mesh"] in meshes]


def write_scores(path: Path, rows: list[Row]) -> None:
    """Write every score, all digits, under the column names of `val.csv`."""
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)


def format_value(column: str, value: Any) -> str:
    """Return a score to its column's digits; nothing where there is none."""
    return "" if value in (None, "") else f"{value:.{COLUMNS[column]}f}"


def print_table(head: list[str], rows: list[tuple[list[str], Row]]) -> None:
    """Print rows as Markdown: a few words first, then the columns."""
    click.echo("| " + " | ".join([*head, *COLUMNS]) + " |")
    click.echo("|" + "---|" * (len(head) + len(COLUMNS)))
    for words, row in rows:
        click.echo("| " + " | ".join([*words, *(format_value(c, row.get(c)) for c in COLUMNS)]) + " |")


def mean(rows: list[Row]) -> Row:
    """Return the mean of every column that the rows have."""
    present = {column: [row[column] for row in rows if row.get(column) not in (None, "")] for column in COLUMNS}
    return {column: float(np.mean(values)) for column, values in present.items() if values}


def print_report(ours: list[Row], rivals: list[Row]) -> None:
    """Print the means over the meshes that came out, then every mesh."""
    done = [row["mesh"] for row in ours if row["status"] == "ok"]
    click.echo(f"## Means over {len(done)} meshes, {POINTS} points each\n")
    peers = dict.fromkeys(row["peer"] for row in rivals)
    everything = {OURS: ours} | {peer: [row for row in rivals if row["peer"] == peer] for peer in peers}
    counted = {
        peer: [row for row in rows if row["status"] == "ok" and row["mesh"] in done]
        for peer, rows in everything.items()
    }
    print_table(["method", "ok"], [([peer, f"{len(rows)}/{len(ours)}"], mean(rows)) for peer, rows in counted.items()])

    click.echo(f"\n## By mesh: {OURS}, the other method with the smallest CDs, the sampling floor\n")
    lines = []
    for row in ours:
        if row["status"] != "ok":
            lines.append(([row["mesh"], f"{OURS}: {row['note']}"], Row()))
            continue
        others = [other for other in rivals if other["mesh"] == row["mesh"]]
        floor = [other for other in others if other["peer"] == FLOOR]
        best = sorted((other for other in others if other["peer"] != FLOOR), key=lambda other: other["CDs"])[:1]
        lines += [([line["mesh"], line["peer"]], line) for line in (row, *best, *floor)]
    print_table(["mesh", "method"], lines)


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.argument("baselines", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/baselines")
@click.option("--meshes", help="only these, by name: bull,trex")
@click.option("--vertices", default=5180, show_default=True)
@click.option(
    "--embedding",
    default=EmbeddingOptions().embedding,
    show_default=True,
    help=f"as of hdpea reconstruct, or one to compare with: {', '.join(REFERENCES)}",
)
@click.option("--weights", help="of the learned embedding")
@click.option("--refine/--no-refine", default=True, show_default=True)
@click.option("--jobs", default=1, show_default=True, help="meshes at a time; more than 1 spoils the seconds")
@click.option("--save", type=click.Path(path_type=Path), help="folder for the meshes and scores.csv")
@click.option("--picture", is_flag=True, help="with --save: a picture of each mesh, too")
def main(
    *,
    folder: Path,
    baselines: Path,
    meshes: str | None,
    vertices: int,
    embedding: str,
    weights: str | None,
    refine: bool,
    jobs: int,
    save: Path | None,
    picture: bool,
) -> None:
    """Reconstruct the meshes of FOLDER from samples; print the scores beside those in BASELINES."""
    paths = meshes_of(folder, meshes)
    if save:
        save.mkdir(parents=True, exist_ok=True)
    reference = embedding if embedding in REFERENCES else None
    options = Options(
        embedding=EmbeddingOptions() if reference else EmbeddingOptions(embedding=embedding, weights=weights),
        meshing=MeshingOptions(vertices=vertices),
        refinement=RefinementOptions(refine=refine),
    )
    tasks = [Task(path, baselines, options, reference, save, picture) for path in paths]
    with ThreadPoolExecutor(jobs) as pool:
        ours = list(pool.map(run_isolated, tasks))
    if save:
        write_scores(save / "scores.csv", ours)
    print_report(ours, read_rivals(baselines, [path.stem for path in paths]))


if __name__ == "__main__":
    main()
