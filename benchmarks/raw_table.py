# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of raw clouds: strays, depth frames, lidar rings; beside a plain pipeline, and against the bounds.

    python benchmarks/raw_table.py [--meshes bull,trex] [--kinds strays,rings] [--save DIR] [--options "--seed 1"]

The clouds, the scores and the plain pipeline are those of `raw.py` in the baselines' folder, whose `raw.csv` has the
rows of the plain pipeline; `--plain FILE` takes others, `--plain run` measures them here and needs Open3D. Prints
Markdown; a run without a mesh is a row with its exit code. Needs the `bench` dependency group and embreex (`make
bench-setup` has both).
"""

from __future__ import annotations

import csv
import os
import shlex
import sys
import tempfile
import time
import zlib
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

import click
import numpy as np
import trimesh
from keeping import kept
from raw_bounds import bounds_of
from val_table import ROOT, load_script, meshes_of

from hdpea.writing.meshes import write_mesh

SPACINGS_OF = 40_000
"""Points whose spacing on the true surface is the unit of the scores, as in `raw.py`."""

KINDS = ("strays", "views", "rings")
OURS, PLAIN = "hdpea", "o3d"

# Columns, what their values are multiplied by, and their digits.
COLUMNS = {
    "seconds": (1, 1), "nV": (1, 0), "debris": (100, 2), "missed": (100, 2), "rms": (1, 3), "wrong": (100, 2),
    "selfx": (100, 3), "components": (1, 1),
}  # fmt: skip
TITLES = [
    "seconds",
    "vertices",
    "debris, %",
    "missed, %",
    "rms, 1e-3 d",
    "wrong side, %",
    "cut others, %",
    "components",
]

Row = dict[str, Any]


@dataclass(frozen=True)
class Task:
    """A mesh, the kind of raw cloud to make of it, and where to keep what becomes of it."""

    path: Path
    kind: str
    options: tuple[str, ...]
    save: Path | None


def load_raw(baselines: Path) -> ModuleType:
    """Import the baselines' `raw.py`, set to run this hdpea."""
    os.environ.setdefault("HDPEA", f"{sys.executable} -m hdpea")
    try:
        return load_script(baselines / "raw.py")
    except ModuleNotFoundError as error:
        raise click.UsageError(f"{error.name} is not installed: `make bench-setup` installs it.") from error


def measure(raw: ModuleType, task: Task, peer: str) -> Row:
    """Make the cloud, let the method make a mesh of it, and score that; a method that fails is no error."""
    mesh = trimesh.load(task.path, force="mesh", process=True)
    diagonal = float(np.linalg.norm(np.ptp(mesh.bounds, axis=0)))
    random = np.random.default_rng(zlib.crc32(f"{task.path.stem}{task.kind}".encode()))  # the seed of raw.py
    clean, points = raw.KINDS[task.kind](mesh, random, diagonal)
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        try:
            options = task.options if peer == OURS else ()
            code, result = raw.PEERS[peer](points, Path(folder), *options)
        except Exception as error:  # noqa: BLE001 an error of one method must not stop the others
            code, result = f"{type(error).__name__}: {error}"[:60], None
    row: Row = {"mesh": task.path.stem, "kind": task.kind, "peer": peer, "exit": code}
    row["seconds"] = time.perf_counter() - start
    click.echo(f"{task.path.stem}, {task.kind}, {peer}: {code}", err=True)
    if result is None:
        return row
    if task.save is not None:
        write_mesh(task.save / f"{task.path.stem}-{task.kind}-{peer}.ply", *result)
    scores = raw.score(mesh, clean, *result, diagonal, float(np.sqrt(mesh.area / SPACINGS_OF)))
    return row | {name: float(value) for name, value in scores.items()}


def read_rows(path: Path) -> list[Row]:
    """Return the plain pipeline's rows of a CSV that `raw.py` wrote, numbers as numbers; no entry where it has none."""
    words = {"mesh", "kind", "peer", "exit"}
    with path.open() as file:
        rows = [
            {key: value if key in words else float(value) for key, value in row.items() if value}
            for row in csv.DictReader(file)
        ]
    return [row for row in rows if row["peer"] == PLAIN]


def print_rows(rows: list[Row]) -> None:
    """Print every run."""
    click.echo("| mesh | kind | method | exit | " + " | ".join(TITLES) + " |\n|" + "---|" * (4 + len(TITLES)))
    for row in rows:
        words = [str(row[name]) for name in ("mesh", "kind", "peer", "exit")]
        click.echo("| " + " | ".join([*words, *cells(row)]) + " |")


def print_means(rows: list[Row]) -> None:
    """Print the means over the runs that gave a mesh."""
    click.echo("\n| kind | method | exit 0 | meshes | " + " | ".join(TITLES) + " |\n|" + "---|" * (4 + len(TITLES)))
    for kind, peer in dict.fromkeys((row["kind"], row["peer"]) for row in rows):
        of_both = [row for row in rows if (row["kind"], row["peer"]) == (kind, peer)]
        scored = [row for row in of_both if "nV" in row]
        mean = {name: float(np.mean([row[name] for row in scored])) for name in COLUMNS if scored}
        ended_well = sum(str(row["exit"]) == "0" for row in of_both)
        words = [kind, peer, f"{ended_well}/{len(of_both)}", str(len(scored))]
        click.echo("| " + " | ".join([*words, *cells(mean)]) + " |")


def cells(row: Row) -> list[str]:
    """Return the numbers of a row as text, empty where there is none."""
    return [f"{factor * row[name]:.{digits}f}" if name in row else "" for name, (factor, digits) in COLUMNS.items()]


def print_bounds(rows: list[Row]) -> None:
    """Print each bound, what was measured, and whether it holds."""
    click.echo("\n| kind | bound | measured | at most | holds |\n|---|---|---|---|---|")
    for kind in dict.fromkeys(row["kind"] for row in rows):
        ours, plain = ([row for row in rows if (row["kind"], row["peer"]) == (kind, peer)] for peer in (OURS, PLAIN))
        for bound in bounds_of(kind, ours, plain):
            click.echo(f"| {kind} | {bound.name} | {bound.measured:.4g} | {bound.most:.4g} | {bound.verdict} |")


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/data/meshes/val")
@click.argument("baselines", type=click.Path(exists=True, path_type=Path), default=ROOT / "../shared/baselines")
@click.option("--meshes", help="only these, by name: bull,trex")
@click.option("--kinds", default=",".join(KINDS), show_default=True)
@click.option("--plain", help="a CSV with the plain pipeline's rows, or run  [default: raw.csv of BASELINES]")
@click.option("--options", default="", help="of hdpea reconstruct")
@click.option("--save", type=click.Path(path_type=Path), help="folder for meshes and scores, which are not made again")
def main(
    *, folder: Path, baselines: Path, meshes: str | None, kinds: str, plain: str | None, options: str, save: Path | None
) -> None:
    """Reconstruct raw clouds made of the meshes of FOLDER as raw.py of BASELINES does, and score the results."""
    raw, paths = load_raw(baselines), meshes_of(folder, meshes)
    chosen = kinds.split(",")
    if unknown := set(chosen) - set(KINDS):
        raise click.UsageError(f"There is no kind {', '.join(sorted(unknown))}: kinds are {', '.join(KINDS)}.")
    tasks = [Task(path, kind, tuple(shlex.split(options)), save) for kind in chosen for path in paths]

    def measured(peer: str) -> list[Row]:
        return [kept(save, f"{task.path.stem}-{task.kind}-{peer}", partial(measure, raw, task, peer)) for task in tasks]

    if plain == "run":
        if find_spec("open3d") is None:
            raise click.UsageError("Open3D is not installed: pip install open3d-cpu, or give a CSV.")
        others = measured(PLAIN)
    else:
        others = read_rows(Path(plain) if plain else baselines / "raw.csv")
    ours = measured(OURS)
    wanted = {(row["mesh"], row["kind"]) for row in ours}
    rows = ours + [row for row in others if (row["mesh"], row["kind"]) in wanted]
    rows.sort(key=lambda row: (chosen.index(row["kind"]), row["mesh"], row["peer"] != OURS))
    print_rows(rows)
    print_means(rows)
    print_bounds(rows)


if __name__ == "__main__":
    main()
