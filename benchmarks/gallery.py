# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery: twenty clouds and models of Debian's libcgal-demo, and a page of each, to turn.

    python benchmarks/gallery.py build/gallery docs/gallery.md

Clouds are taken as they are, models are scanned first (`hdpea dataset scan --points 20000`). Each mesh is made by
`hdpea reconstruct --faces 2000`, in a process of its own. Writes the page, a picture and the report of each to OUT,
which `make docs` puts on the site, and renews the sheet and the table of PAGE. What lies in OUT is not made again.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
from demo_data import CLOUDS, MODELS, demo_files
from sheets import in_columns, opened, save_jpeg, sheet, shrunk

POINTS, FACES = 20_000, 2_000
SHOWN_CLOUDS = (
    "kitten.xyz", "point_set_3.xyz", "hippo1.ply", "ball.ply", "building.ply", "b9_training.ply", "cube.pwn",
    "sphere_20k.xyz",
)  # fmt: skip
SHOWN_MODELS = (
    "armadillo.off", "bunny00.off", "bull.off", "camel.off", "dino.off", "man.off", "turbine.off", "fandisk.off",
    "knot2.off", "anchor_dense.off", "cheese.off", "couplingdown.off",
)  # fmt: skip
COLUMNS = 4
SMALL = (400, 300)
"""Width and height of a picture on the site and on the sheet, in pixels."""

LARGEST_PICTURE, LARGEST_SHEET = 30_000, 400_000
"""Bytes."""

MARK = "<!-- gallery -->"


@dataclass(frozen=True)
class Shown:
    """What became of a file: a name, the report of the run, and whether it was scanned first."""

    name: str
    report: dict[str, Any]
    scanned: bool


def hdpea(*arguments: object) -> None:
    """Run a command of hdpea; what is not as asked for is shown even so."""
    ended = subprocess.run([sys.executable, "-m", "hdpea", *map(str, arguments)], check=False)
    if ended.returncode not in (0, 5):
        raise click.ClickException(f"hdpea {arguments[0]} ended with exit code {ended.returncode}.")


def made(file: Path, out: Path, scanned: bool) -> Shown:
    """Make the mesh, the picture and the page of a cloud, or of the scan of a model."""
    name = file.stem
    report, picture = out / f"{name}.json", out / f"{name}.png"
    if not report.exists():
        click.echo(name)
        cloud = out / f"{name}.scan.ply" if scanned else file
        if scanned:
            hdpea("dataset", "scan", file, cloud, "--points", POINTS, "--force", "--quiet")
        outputs = ["--report", report, "--page", out / f"{name}.html", "--picture", picture]
        hdpea("reconstruct", cloud, out / f"{name}.ply", "--faces", FACES, *outputs, "--force", "--quiet")
    save_jpeg(shrunk(opened(picture), SMALL), out / f"{name}.jpg", LARGEST_PICTURE)
    return Shown(name, json.loads(report.read_text()), scanned)


def table(shown: Sequence[Shown]) -> str:
    """Return what was made of what, as Markdown."""
    titles = ["", "points kept", "scan", "triangles", "root mean square distance, in spacings", "closed"]
    rows = [f"| {' | '.join(titles)} |", "|---" * len(titles) + "|"]
    for each in shown:
        mesh, distances = each.report["mesh"], each.report["distances"]["in_spacings"]
        cells = [
            each.name,
            f"{each.report['counts']['points']:,}",
            "simulated" if each.scanned else "",
            f"{mesh['faces']:,}",
            f"{distances['rms']:.2f}",
            "yes" if mesh["closed"] else "no",
        ]
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows)


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.argument("page", type=click.Path(exists=True, path_type=Path))
def main(*, out: Path, page: Path) -> None:
    """Make the pages in OUT, and write the sheet and the table of PAGE."""
    clouds = demo_files(out / "clouds", CLOUDS, SHOWN_CLOUDS)
    models = demo_files(out / "models", MODELS, SHOWN_MODELS)
    shown = [made(file, out, scanned) for files, scanned in ((clouds, False), (models, True)) for file in files]
    panels = [(each.name, shrunk(opened(out / f"{each.name}.png"), SMALL)) for each in shown]
    save_jpeg(sheet([*in_columns(panels, COLUMNS)], SMALL), page.with_suffix(".jpg"), LARGEST_SHEET)
    before, _, after = page.read_text().split(MARK)
    page.write_text(f"{before}{MARK}\n{table(shown)}\n{MARK}{after}")


if __name__ == "__main__":
    main()
