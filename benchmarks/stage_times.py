# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and peak memory of the whole command, and of each stage; prints the tables of docs/performance.md.

    python benchmarks/stage_times.py [--points 40000,250000] [--shape knot] [--runs 3]

The command runs as a user runs it, in a process of its own: the whole time holds the start of Python and the reading
and writing of files. Stages are timed by the report that the command writes. Every number is the median of the runs.
"""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import Any

import click

SHAPES = Path(__file__).resolve().parent.parent / "examples" / "shapes.py"
HDPEA = shutil.which("hdpea", path=Path(sys.executable).parent)

Run = dict[str, Any]


def run_once(cloud: Path, folder: Path, arguments: tuple[str, ...]) -> Run:
    """Reconstruct the cloud; return the command's seconds, its peak memory in MB and its report."""
    report = folder / "report.json"
    command = [str(HDPEA), "reconstruct", str(cloud), str(folder / "mesh.ply"), "--report", str(report), "--quiet"]
    start = time.perf_counter()
    process = subprocess.Popen([*command, *arguments])
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    if status:
        raise click.ClickException(f"exit code {os.waitstatus_to_exitcode(status)} of: {' '.join(command)}")
    return {"seconds": seconds, "memory": usage.ru_maxrss / 1024, "report": json.loads(report.read_text())}


def print_tables(points: list[int], runs: dict[int, list[Run]]) -> None:
    """Print a row for each stage and for the whole, a column for each size of cloud."""
    click.echo(f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}.\n")
    click.echo("| seconds | " + " | ".join(f"{count:,} points" for count in points) + " |")
    click.echo("|---|" + "---|" * len(points))
    stages = [stage["name"] for stage in runs[points[0]][0]["report"]["stages"]]
    for row, stage in enumerate(stages):
        times = [median(run["report"]["stages"][row]["seconds"] for run in runs[count]) for count in points]
        click.echo(f"| {stage} | " + " | ".join(f"{seconds:.2f}" for seconds in times) + " |")
    for label, key, digits in (("**the whole command**", "seconds", 2), ("peak memory, MB", "memory", 0)):
        values = [median(run[key] for run in runs[count]) for count in points]
        click.echo(f"| {label} | " + " | ".join(f"{value:.{digits}f}" for value in values) + " |")
    for label, key in (("vertices out", "vertices"), ("faces out", "faces")):
        click.echo(
            f"| {label} | " + " | ".join(f"{runs[count][0]['report']['mesh'][key]:,}" for count in points) + " |"
        )


@click.command(context_settings={"ignore_unknown_options": True})
@click.option("--points", default="40000,250000", show_default=True, help="sizes of the clouds")
@click.option("--shape", default="knot", show_default=True, help="a shape of examples/shapes.py")
@click.option("--runs", default=3, show_default=True)
@click.argument("arguments", nargs=-1, type=click.UNPROCESSED)
def main(points: str, shape: str, runs: int, arguments: tuple[str, ...]) -> None:
    """Time `hdpea reconstruct`; further ARGUMENTS go to it."""
    counts = [int(count) for count in points.split(",")]
    measured: dict[int, list[Run]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for count in counts:
            cloud = folder / "cloud.ply"
            subprocess.run([sys.executable, str(SHAPES), shape, str(cloud), "--points", str(count)], check=True)
            measured[count] = [run_once(cloud, folder, arguments) for _ in range(runs)]
    print_tables(counts, measured)


if __name__ == "__main__":
    main()
