# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and peak memory of the whole command, and of each stage; prints the table of docs/performance.md.

    python benchmarks/stage_times.py [--points 40000,250000] [--shape knot] [--runs 3]

The command runs as a user runs it, in a process of its own: the total time includes the start of Python and the reading
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


def seconds_by_stage(run: Run) -> dict[str, float]:
    """Return the seconds of each stage, summed over repetitions, and of the time outside of any stage."""
    seconds: dict[str, float] = {}
    for stage in run["report"]["stages"]:
        if stage["level"] == 0:
            seconds[stage["name"]] = seconds.get(stage["name"], 0) + stage["seconds"]
    return seconds | {"Python and imports": run["seconds"] - sum(seconds.values())}


def print_row(label: str, values: list[float], digits: int) -> None:
    """Print a row of Markdown."""
    click.echo(f"| {label} | " + " | ".join(f"{value:,.{digits}f}" for value in values) + " |")


def print_table(measured: dict[int, list[Run]]) -> None:
    """Print a row for each stage and for the whole, a column for each size of cloud."""
    click.echo(f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}.\n")
    click.echo("| seconds | " + " | ".join(f"{count:,} points" for count in measured) + " |")
    click.echo("|---|" + "---|" * len(measured))
    stages = [[seconds_by_stage(run) for run in runs] for runs in measured.values()]
    for name in stages[0][0]:
        print_row(name, [median(run[name] for run in runs) for runs in stages], 2)
    print_row("**the whole command**", [median(run["seconds"] for run in runs) for runs in measured.values()], 2)
    print_row("peak memory, MB", [median(run["memory"] for run in runs) for runs in measured.values()], 0)
    for fact in ("vertices", "faces"):
        print_row(f"{fact} out", [runs[0]["report"]["mesh"][fact] for runs in measured.values()], 0)


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
    print_table(measured)


if __name__ == "__main__":
    main()
