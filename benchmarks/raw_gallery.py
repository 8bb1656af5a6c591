# SPDX-License-Identifier: GPL-3.0-or-later
"""Raw clouds, and what becomes of each: a picture of the points beside that of the mesh, and a table of what is wrong.

    python benchmarks/raw_gallery.py build/raw [--before FOLDER] [CLOUD ...]

Without clouds these are the raw ones of ../shared/data/clouds and all those of Debian's libcgal-demo. FOLDER holds
another hdpea, such as an older one: what `pip install --target FOLDER` leaves there. Every run is a process of its own
with one thread. Writes a picture of each cloud, and `gallery.jpg` of all, and prints Markdown; a run without a mesh is
a row with its exit code. Meshes and measurements that lie in the folder already are not made again.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import click
from demo_data import CLOUDS, demo_files
from gallery_measures import Known, mesh_measures
from keeping import kept
from PIL import Image
from sheets import Mesh, in_columns, mesh_picture, opened, points_picture, save_jpeg, sheet, shrunk
from val_table import ROOT

from hdpea.errors import HdpeaError
from hdpea.pictures.picture import Camera
from hdpea.reading.triangle_mesh import read_triangle_mesh

PANEL = (640, 480)
"""Width and height of a picture of a cloud or a mesh, in pixels."""

ON_SHEET = 200
"""Its width on the sheet of all."""

COLUMNS = 2
"""Clouds beside each other on the sheet."""

LARGEST = 400_000
"""Bytes of the sheet."""

TITLES = {
    "version": "version", "exit": "exit", "seconds": "seconds", "vertices": "vertices", "closed": "closed",
    "components": "components", "small": "of < 20 faces", "loops": "loops", "cuts": "cuts", "wrong": "wrong side, %",
    "patches": "wrong patches", "long": "long, %", "missed": "missed, %", "off": "off, %",
}  # fmt: skip


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
    row = cloud_row(cloud.name, known, {name: meshes.get(name) for name in versions})
    row.save(out / f"{cloud.name}.png", optimize=True)
    return rows


def cloud_row(title: str, known: Known, meshes: Mapping[str, Mesh | None]) -> Image.Image:
    """Draw the points of a cloud, and every mesh of it from the same place; nothing where there is none."""
    points = known.frame.to_world(known.points)
    camera = Camera.before_points(points, known.normals)
    drawn = [(name, mesh and mesh_picture(mesh, PANEL, camera)) for name, mesh in meshes.items()]
    return sheet([[(title, points_picture(points, known.normals, PANEL, camera)), *drawn]], PANEL, font_size=26)


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
    paths = clouds or (*sorted((ROOT / "../shared/data/clouds").glob("*.ply")), *demo_files(out / "clouds", CLOUDS))
    versions: dict[str, Path | None] = ({} if before is None else {"before": before}) | {"after": None}
    click.echo(f"| cloud | {' | '.join(TITLES.values())} |\n|{'---|' * (1 + len(TITLES))}")
    for path in paths:
        print_rows(path.name, rows_of(path, out, versions, timeout))
    pictures = [opened(each) for path in paths if (each := out / f"{path.name}.png").exists()]
    if pictures:
        width = ON_SHEET * (1 + len(versions))
        small = [("", shrunk(each, (width, each.height * width // each.width))) for each in pictures]
        save_jpeg(sheet([*in_columns(small, COLUMNS)], small[0][1].size), out / "gallery.jpg", LARGEST)


if __name__ == "__main__":
    main()
