# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and peak memory of the whole command, and of each stage; prints the table of docs/performance.md.

    python benchmarks/stage_times.py [--points 40000,250000] [--bare 40000] [--scan scans.ply] [--shape knot] [--runs 3]

The command runs as a user runs it, in a process of its own: the total time includes the start of Python and the reading
and writing of files. Stages are timed by the report that the command writes. Every number is the median of the runs.
Processor time is that of all threads, with the system's: it changes less than the seconds where other programs run.
"""

from __future__ import annotations

import json
import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import Any

import click
import numpy as np

from hdpea import read_points

SHAPES = Path(__file__).resolve().parent.parent / "examples" / "shapes.py"

Run = dict[str, Any]


def run_once(cloud: Path, folder: Path, arguments: tuple[str, ...]) -> Run:
    """Reconstruct the cloud; return the command's seconds, its peak memory in MB and its report."""
    report = folder / "report.json"
    command = [sys.executable, "-m", "hdpea", "reconstruct", str(cloud), str(folder / "mesh.ply"), "--quiet", "--force"]
    start = time.perf_counter()
    process = subprocess.Popen([*command, "--report", str(report), *arguments])
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    if status:
        raise click.ClickException(f"exit code {os.waitstatus_to_exitcode(status)} of: {' '.join(command)}")
    made = json.loads(report.read_text())
    # What the system says is the peak since the last stage began, as measuring a stage resets it.
    memory = max(stage["peak_bytes"] for stage in made["stages"]) / 1e6
    return {"seconds": seconds, "cpu": usage.ru_utime + usage.ru_stime, "memory": memory, "report": made}


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


def print_table(measured: dict[str, list[Run]]) -> None:
    """Print a row for each stage and for the whole, a column for each cloud."""
    click.echo(f"{os.cpu_count()} cores, {platform.machine()}, Python {platform.python_version()}.\n")
    click.echo("| seconds | " + " | ".join(measured) + " |")
    click.echo("|---|" + "---|" * len(measured))
    stages = [[seconds_by_stage(run) for run in runs] for runs in measured.values()]
    # The longest list has the stages that others do without.
    for name in max((runs[0] for runs in stages), key=len):
        print_row(name, [median(run.get(name, 0) for run in runs) for runs in stages], 2)
    print_row("**the whole command**", [median(run["seconds"] for run in runs) for runs in measured.values()], 2)
    print_row("its processor time", [median(run["cpu"] for run in runs) for runs in measured.values()], 2)
    print_row("peak memory, MB", [median(run["memory"] for run in runs) for runs in measured.values()], 0)
    for fact in ("vertices", "faces"):
        print_row(f"{fact} out", [runs[0]["report"]["mesh"][fact] for runs in measured.values()], 0)


@click.command(context_settings={"ignore_unknown_options": True})
@click.option("--points", default="40000,250000", show_default=True, help="sizes of the clouds with normals")
@click.option("--bare", default="40000", show_default=True, help="sizes of the clouds without; none: ''")
@click.option("--scan", multiple=True, type=click.Path(exists=True, path_type=Path), help="a file of yours, too")
@click.option("--shape", default="knot", show_default=True, help="a shape of examples/shapes.py")
@click.option("--runs", default=3, show_default=True)
@click.argument("arguments", nargs=-1, type=click.UNPROCESSED)
def main(points: str, bare: str, scan: tuple[Path, ...], shape: str, runs: int, arguments: tuple[str, ...]) -> None:
    """Time `hdpea reconstruct`; further ARGUMENTS go to it."""
    measured: dict[str, list[Run]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        clouds = {path.stem: path for path in scan}
        for count in sizes(points):
            clouds[f"{count:,} points"] = made(shape, count, folder)
        for count in sizes(bare):
            clouds[f"{count:,} without normals"] = made_bare(shape, count, folder)
        for label, cloud in clouds.items():
            measured[label] = [run_once(cloud, folder, arguments) for _ in range(runs)]
    print_table(measured)


def sizes(text: str) -> list[int]:
    """Return the numbers of a list with commas."""
    return [int(count) for count in text.split(",") if count]


def made(shape: str, count: int, folder: Path) -> Path:
    """Sample a shape."""
    cloud = folder / f"{count}.ply"
    subprocess.run([sys.executable, str(SHAPES), shape, str(cloud), "--points", str(count)], check=True)
    return cloud


def made_bare(shape: str, count: int, folder: Path) -> Path:
    """Sample a shape without its normals."""
    cloud = folder / f"{count}.npy"
    np.save(cloud, read_points(made(shape, count, folder)).points)
    return cloud


if __name__ == "__main__":
    main()
