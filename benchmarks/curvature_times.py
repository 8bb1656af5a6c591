# SPDX-License-Identifier: GPL-3.0-or-later
"""Time and peak memory of `hdpea curvature`, the whole command; prints the table of docs/curvature.md.

    python benchmarks/curvature_times.py [--points 40000,1000000] [--shape knot] [--methods embedding,jet]

The command runs as a user runs it, in a process of its own: the times include the start of Python and the reading and
writing of files. Processor seconds are those of all threads together; elapsed ones are meaningful only on an idle
machine.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import click
import numpy as np

from hdpea.reading import read_points
from hdpea.writing.points import point_ply

SHAPES = Path(__file__).resolve().parent.parent / "examples" / "shapes.py"


def print_row(cloud: Path, count: int, normals: str, method: str) -> None:
    """Run the command on the cloud, and print a row of Markdown."""
    out = cloud.with_name("curvature.ply")
    command = [sys.executable, "-m", "hdpea", "curvature", str(cloud), str(out), "--method", method, "--quiet"]
    start = time.perf_counter()
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    elapsed = time.perf_counter() - start
    if status:
        raise click.ClickException(f"exit code {os.waitstatus_to_exitcode(status)} of: {' '.join(command)}")
    seconds, gigabytes = usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e9
    click.echo(f"| {count:,} | {normals} | {method} | {seconds:.1f} | {elapsed:.1f} | {gigabytes:.2f} |")


@click.command()
@click.option("--points", default="40000,1000000", show_default=True, help="sizes of the clouds")
@click.option("--shape", default="knot", show_default=True, help="a shape of examples/shapes.py")
@click.option("--methods", default="embedding,jet", show_default=True)
def main(points: str, shape: str, methods: str) -> None:
    """Time `hdpea curvature` on clouds without normals and with them."""
    click.echo("| points | normals | method | processor seconds | elapsed | peak memory, GB |")
    click.echo("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        given, bare = Path(name) / "given.ply", Path(name) / "bare.npy"
        for count in map(int, points.split(",")):
            subprocess.run([sys.executable, str(SHAPES), shape, str(given), "--points", str(count)], check=True)
            cloud = read_points(str(given))
            if cloud.normals is None:
                raise click.ClickException(f"{shape} has no normals")
            given.write_bytes(point_ply(cloud.points, cloud.normals, {}))
            np.save(bare, cloud.points)
            for method in methods.split(","):
                print_row(bare, count, "", method)
                print_row(given, count, "given", method)


if __name__ == "__main__":
    main()
