# SPDX-License-Identifier: GPL-3.0-or-later
"""Fit the cost model of `hdpea info` to runs in one piece; prints the runs, and the numbers of hdpea/report/cost.py.

    python benchmarks/cost_fit.py [--sizes 10000/1250,40000/5000] [--bare 40000/5000] [--runs runs.json]

Each size is a cloud of so many points of a knot with normals, and the vertices wanted; bare ones have no normals. The
last columns are a run of the command in a process of its own, the ones before what the fitted model says of it.
Processor time is that of all threads, with the system's: it changes less than the seconds where other programs run.
With `--runs` what was measured is kept in a file, so that a fit takes no second measurement.
"""

from __future__ import annotations

import itertools
import json
import tempfile
from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls
from stage_times import made, made_bare, run_once

from hdpea.report.cost import Cost

SIZES = (
    "10000/1250,10000/4000,40000/5000,40000/15000,100000/12500,250000/10000,250000/31250,1000000/100000,4000000/500000"
)
BARE = "10000/1250,40000/5000,100000/12500,250000/31250,1000000/100000"
WITHOUT = " without normals"

POWERS = np.arange(1.0, 1.51, 0.05)
"""Of the points and of the vertices, that are tried."""

Measured = dict[str, float]


@click.command()
@click.option("--sizes", default=SIZES, show_default=True, help="points/vertices of each run")
@click.option("--bare", default=BARE, show_default=True, help="the same of runs without normals")
@click.option("--runs", type=click.Path(path_type=Path), help="a file for what was measured, and of what was before")
def main(sizes: str, bare: str, runs: Path | None) -> None:
    """Measure runs, fit both costs to them, and print Markdown."""
    known: dict[str, Measured] = json.loads(runs.read_text()) if runs is not None and runs.exists() else {}
    for name in [*sizes.split(","), *(size + WITHOUT for size in bare.split(","))]:
        if name not in known:
            known[name] = measured(*counts(name), bare=name.endswith(WITHOUT))
            if runs is not None:
                runs.write_text(json.dumps(known, indent=1))
    seconds, memory = (fitted(known, what, powers) for what, powers in (("seconds", POWERS), ("bytes", np.ones(1))))
    click.echo("| points | vertices | processor s, fitted | measured | memory, MB, fitted | measured |")
    click.echo("|---|---|---|---|---|---|")
    for name, run in known.items():
        points, vertices = counts(name)
        label = f"{points:,}{WITHOUT if name.endswith(WITHOUT) else ''}"
        says = f"{seconds.of(points, vertices):.1f} | {run['seconds']:.1f}"
        click.echo(f"| {label} | {vertices:,} | {says} | {memory.of(points, vertices) / 1e6:.0f} |", nl=False)
        click.echo(f" {run['bytes'] / 1e6:.0f} |")
    click.echo(f"\nProcessor seconds: {seconds}\nBytes: {memory}")


def counts(name: str) -> tuple[int, int]:
    """Return the points and the vertices of a run."""
    points, vertices = name.removesuffix(WITHOUT).split("/")
    return int(points), int(vertices)


def measured(points: int, vertices: int, bare: bool) -> Measured:
    """Make a mesh of so many points by the command."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cloud = (made_bare if bare else made)("knot", points, folder)
        run = run_once(cloud, folder, ("--vertices", str(vertices)))
    return {"seconds": run["cpu"], "bytes": run["memory"] * 1e6}


def fitted(runs: dict[str, Measured], what: str, powers: NDArray[np.float64]) -> Cost:
    """Return the cost whose relative errors are least in the sum of their squares, without negative parts."""
    sizes = np.array([counts(name) for name in runs]) / 1000
    wanted = np.array([run[what] for run in runs.values()])
    best, least = Cost(0, 0, 0), np.inf
    for of_points, of_vertices in itertools.product(powers, powers):
        design = np.column_stack([np.ones(len(sizes)), sizes[:, 0] ** of_points, sizes[:, 1] ** of_vertices])
        parts, error = nnls(design / wanted[:, None], np.ones(len(sizes)))
        if error < least:
            best, least = Cost(*parts.tolist(), round(float(of_points), 2), round(float(of_vertices), 2)), error
    return best


if __name__ == "__main__":
    main()
