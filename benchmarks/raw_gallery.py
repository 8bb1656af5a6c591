# SPDX-License-Identifier: GPL-3.0-or-later
"""Raw clouds, and what becomes of each: a picture of the points beside that of the mesh, and a table of what is wrong.

    python benchmarks/raw_gallery.py build/gallery [--before FOLDER] [CLOUD ...]

Without clouds these are the raw ones of ../shared/data/clouds and all those of Debian's libcgal-demo. FOLDER holds
another hdpea, such as an older one: what `pip install --target FOLDER` leaves there. Every run is a process of its own
with one thread. Writes a picture of each cloud, and `gallery.jpg` of all, and prints Markdown; a run without a mesh is
a row with its exit code. Meshes and measurements that lie in the folder already are not made again.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tarfile
import time
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import click
from gallery_measures import Known, mesh_measures
from gallery_pictures import draw_cloud, draw_sheet
from keeping import kept
from val_table import ROOT

from hdpea.errors import HdpeaError
from hdpea.reading.triangle_mesh import read_triangle_mesh

DEMO_CLOUDS = Path("/usr/share/doc/libcgal-dev/data.tar.gz")
"""Where Debian's libcgal-demo has its clouds, as `make demo` knows."""

TITLES = {
    "version": "version", "exit": "exit", "seconds": "seconds", "vertices": "vertices", "closed": "closed",
    "components": "components", "small": "of < 20 faces", "loops": "loops", "cuts": "cuts", "wrong": "wrong side, %",
    "patches": "wrong patches", "long": "long, %", "missed": "missed, %", "off": "off, %",
}  # fmt: skip


def demo_clouds(folder: Path) -> list[Path]:
    """Unpack the clouds of libcgal-demo, and return their paths."""
    if not DEMO_CLOUDS.exists():
        raise click.UsageError("libcgal-demo is not installed: apt-get install libcgal-demo, or give clouds.")
    folder.mkdir(parents=True, exist_ok=True)
    with tarfile.open(DEMO_CLOUDS) as archive:
        for member in archive:
            if member.isfile() and member.name.startswith("data/points_3/"):
                member.name = Path(member.name).name
                archive.extract(member, folder, filter="data")
    return sorted(folder.iterdir())


def run(cloud: Path, mesh: Path, package: Path | None, timeout: float) -> dict[str, Any]:
    """Reconstruct a cloud by the hdpea of a folder, or the installed one, in a process of its own."""
    environment = os.environ | {"OMP_NUM_THREADS": "1"}
    if package is not None:
        environment["PYTHONPATH"] = str(package.resolve())
    command = [sys.executable, "-m", "hdpea", "reconstruct", str(cloud), str(mesh), "--threads", "1", "--quiet"]
    start = time.perf_counter()
    try:
        ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=timeout, check=False)
        result: dict[str, Any] = {"exit": ended.returncode, "told": ended.stderr.strip()}
    except subprocess.TimeoutExpired:
        result = {"exit": "timeout"}
    return result | {"seconds": round(time.perf_counter() - start, 1)}


def rows_of(cloud: Path, out: Path, versions: dict[str, Path | None], timeout: float) -> list[dict[str, Any]]:
    """Reconstruct a cloud by every version, measure the meshes, and draw them."""
    try:
        known = Known.of(cloud)
    except HdpeaError as error:
        return [{"version": "", "exit": error.exit_code, "told": error.message}]
    meshes, rows = {}, []
    for version, package in versions.items():
        name = f"{cloud.name}-{version}"
        mesh = out / f"{name}.ply"
        row = {"version": version} | kept(out, name, partial(run, cloud, mesh, package, timeout))
        if mesh.exists():
            meshes[version] = read_triangle_mesh(mesh)
            row |= kept(out, f"{name}-measures", lambda made=meshes[version]: asdict(mesh_measures(*made, known)))
        rows.append(row)
    draw_cloud(out / f"{cloud.name}.png", cloud.name, known, {name: meshes.get(name) for name in versions})
    return rows


def print_rows(cloud: str, rows: Sequence[dict[str, Any]]) -> None:
    """Print what became of a cloud."""
    for row in rows:
        cells = [f"{row.get(key, ''):.2f}" if isinstance(row.get(key), float) else row.get(key, "") for key in TITLES]
        click.echo(f"| {cloud} | {' | '.join(map(str, cells))} |")


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.argument("clouds", nargs=-1, type=click.Path(exists=True, path_type=Path))
@click.option("--before", type=click.Path(exists=True, path_type=Path), help="folder with another hdpea")
@click.option("--timeout", default=600.0, show_default=True, help="seconds of a run")
def main(*, out: Path, clouds: tuple[Path, ...], before: Path | None, timeout: float) -> None:
    """Reconstruct CLOUDS, and write pictures and meshes to OUT."""
    paths = clouds or (*sorted((ROOT / "../shared/data/clouds").glob("*.ply")), *demo_clouds(out / "clouds"))
    versions: dict[str, Path | None] = ({} if before is None else {"before": before}) | {"after": None}
    click.echo(f"| cloud | {' | '.join(TITLES.values())} |\n|{'---|' * (1 + len(TITLES))}")
    for path in paths:
        print_rows(path.name, rows_of(path, out, versions, timeout))
    pictures = [out / f"{path.name}.png" for path in paths]
    draw_sheet(out / "gallery.jpg", [each for each in pictures if each.exists()])


if __name__ == "__main__":
    main()
