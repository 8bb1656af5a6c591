# SPDX-License-Identifier: GPL-3.0-or-later
"""What clouds of all sizes take beside what was aimed at; prints the first table of docs/performance.md.

    python benchmarks/budgets.py [--runs 5] [--only '40,000'] [--scan scans.ply] [--earlier PYTHONPATH]

The clouds are knots, their vertices those of the table, and the scan one of yours without normals, to 12,000 vertices.
Each run is the whole command as `stage_times.py` times it, and the numbers are medians. Where there is something to
compare with, it runs in turns with ours: Poisson reconstruction and quadric edge collapse by MeshLab (`pymeshlab`) to
as many faces, and for the scan an earlier version of hdpea, installed into the folder that `--earlier` names.
"""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import click
from stage_times import Run, made, made_bare, run_once

MILLIONS = 1_000_000

PLAIN = """
import sys, pymeshlab
cloud, out, vertices, depth = sys.argv[1:]
meshes = pymeshlab.MeshSet()
meshes.load_new_mesh(cloud)
meshes.generate_surface_reconstruction_screened_poisson(depth=int(depth), preclean=True)
meshes.meshing_decimation_quadric_edge_collapse(targetfacenum=2 * int(vertices))
meshes.save_current_mesh(out)
"""


@dataclass(frozen=True)
class Row:
    """A cloud, and the seconds and GB that were aimed at; `plain_depth` is the octree of Poisson, 0 for none."""

    points: int
    vertices: int
    seconds: float
    memory: float
    bare: bool = False
    plain_depth: int = 0
    arguments: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """How the table calls the cloud."""
        return f"{self.points:,}, {'none' if self.bare else 'normals'}"


ROWS = (
    Row(40_000, 5_000, 3, 0.4, plain_depth=8),
    Row(40_000, 5_000, 4, 0.4, bare=True),
    Row(250_000, 31_250, 15, 0.6, plain_depth=9),
    Row(MILLIONS, 100_000, 75, 2, plain_depth=10),
    Row(10 * MILLIONS, 500_000, 900, 8, arguments=("--memory", "8GB", "--jobs", "2")),
)


@click.command()
@click.option("--runs", default=5, show_default=True, help="the median is printed; one from a million points on")
@click.option("--only", default="", help="rows whose name holds this")
@click.option("--scan", type=click.Path(exists=True, path_type=Path), help="a raw scan without normals, too")
@click.option("--earlier", type=click.Path(exists=True, path_type=Path), help="an earlier hdpea, for the scan")
def main(runs: int, only: str, scan: Path | None, earlier: Path | None) -> None:
    """Time the rows of the table."""
    click.echo(f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}.\n")
    click.echo("| cloud | vertices | seconds | aimed at | processor s | GB | aimed at | in turns |")
    click.echo("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for row in (row for row in ROWS if only in row.name):
            cloud = (made_bare if row.bare else made)("knot", row.points, folder)
            several = 1 if row.points >= MILLIONS else runs
            ours, plain = [], []
            for _ in range(several):
                ours.append(run_once(cloud, folder, ("--vertices", str(row.vertices), *row.arguments)))
                if row.plain_depth:
                    plain.append(seconds_of_plain(cloud, folder, row))
            print_row(row.name, row.vertices, ours, (row.seconds, row.memory), plain, "Poisson and collapse")
            cloud.unlink()
        if scan:
            arguments = ("--vertices", "12000")
            ours, before = [], []
            for _ in range(runs):
                ours.append(run_once(scan, folder, arguments))
                if earlier:
                    before.append(seconds_of_earlier(scan, folder, earlier, arguments))
            aimed = 0.4 * median(before) if before else float("nan")
            print_row(scan.stem, 12_000, ours, (aimed, 0.9), before, "earlier")


def seconds_of_plain(cloud: Path, folder: Path, row: Row) -> float:
    """Return the seconds of Poisson reconstruction and collapse, in a process of its own."""
    command = [sys.executable, "-c", PLAIN, str(cloud), str(folder / "plain.ply"), str(row.vertices)]
    start = time.perf_counter()
    subprocess.run([*command, str(row.plain_depth)], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start


def seconds_of_earlier(cloud: Path, folder: Path, packages: Path, arguments: tuple[str, ...]) -> float:
    """Return the seconds of the command of an earlier version."""
    command = [sys.executable, "-m", "hdpea", "reconstruct", str(cloud), str(folder / "earlier.ply"), *arguments]
    (folder / "earlier.ply").unlink(missing_ok=True)
    start = time.perf_counter()
    subprocess.run(command, check=True, env=os.environ | {"PYTHONPATH": str(packages)}, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


def print_row(
    name: str, vertices: int, ours: list[Run], aimed: tuple[float, float], others: list[float], of: str
) -> None:
    """Print a row of Markdown; in turns: the seconds of the others, and ours by theirs."""
    seconds, processor, memory = (median(run[key] for run in ours) for key in ("seconds", "cpu", "memory"))
    turns = f"{of}: {median(others):.2f} s, ratio {seconds / median(others):.2f}" if others else ""
    click.echo(
        f"| {name} | {vertices:,} | {seconds:.2f} | {aimed[0]:,.1f} | {processor:.1f} | {memory / 1000:.2f} "
        f"| {aimed[1]:.1f} | {turns} |"
    )


if __name__ == "__main__":
    main()
