# SPDX-License-Identifier: GPL-3.0-or-later
"""The gallery: docs/gallery.md's picture and table, and a folder of pages that turn.

    python benchmarks/gallery_page.py build/gallery docs/gallery.md FILE ...

Each FILE is a cloud, or a model, of which simulated scans are made first (`hdpea dataset scan --points 20000`). Every
mesh is made by `hdpea reconstruct --page`, with 2,000 faces, in a process of its own. OUT/index.html shows all of them
and leads to the pages. What lies in OUT already is not made again.
"""

from __future__ import annotations

import html
import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click
from PIL import Image, ImageDraw, ImageFont

from hdpea.reading.triangle_mesh import read_triangle_mesh

POINTS, FACES = 20_000, 2_000
MODELS = (".ply", ".obj", ".stl", ".off")
COLUMNS = 4
TILE = (400, 320)
"""Width and height of a picture on the sheet, in pixels, with the line below it."""

LINE = 24
QUALITY = 80
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


def is_model(file: Path) -> bool:
    """Tell whether a file has faces."""
    return file.suffix in MODELS and len(read_triangle_mesh(file)[1]) > 0


def made(file: Path, out: Path) -> Shown:
    """Make the mesh, the picture and the page of a file."""
    name, model = file.stem, is_model(file)
    report = out / f"{name}.json"
    if not report.exists():
        cloud = file
        if model:
            cloud = out / f"{name}.scan.ply"
            hdpea("dataset", "scan", file, cloud, "--points", POINTS, "--force", "--quiet")
        outputs = ["--report", report, "--page", out / f"{name}.html", "--picture", out / f"{name}.png"]
        hdpea("reconstruct", cloud, out / f"{name}.ply", "--faces", FACES, *outputs, "--force", "--quiet")
    return Shown(name, json.loads(report.read_text()), model)


def draw_sheet(path: Path, out: Path, shown: Sequence[Shown]) -> None:
    """Put the pictures on one sheet, with their names."""
    width, height = TILE
    sheet = Image.new("RGB", (COLUMNS * width, -(-len(shown) // COLUMNS) * height), "white")
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(16)
    for place, each in enumerate(shown):
        left, top = place % COLUMNS * width, place // COLUMNS * height
        with Image.open(out / f"{each.name}.png") as picture:
            sheet.paste(picture.convert("RGB").resize((width, height - LINE), Image.Resampling.LANCZOS), (left, top))
        draw.text((left + width / 2, top + height - LINE / 2), each.name, fill="black", font=font, anchor="mm")
    sheet.save(path, quality=QUALITY, optimize=True)


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


def index(shown: Sequence[Shown]) -> str:
    """Return a page that leads to all of them."""
    links = [
        f'<a href="{name}.html"><img src="{name}.png" width="400" alt=""><br>{name}</a>'
        for name in (html.escape(each.name) for each in shown)
    ]
    style = "<style>body{font-family:sans-serif;text-align:center}a{display:inline-block;margin:8px}</style>"
    return "\n".join(["<!doctype html><meta charset=utf-8><title>hdpea: gallery</title>", style, *links])


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.argument("page", type=click.Path(exists=True, path_type=Path))
@click.argument("files", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path))
def main(*, out: Path, page: Path, files: tuple[Path, ...]) -> None:
    """Make pages of FILES in OUT, and write the picture and the table of PAGE."""
    out.mkdir(parents=True, exist_ok=True)
    shown = [made(file, out) for file in files]
    (out / "index.html").write_text(index(shown))
    draw_sheet(page.with_suffix(".jpg"), out, shown)
    before, _, after = page.read_text().split(MARK)
    page.write_text(f"{before}{MARK}\n{table(shown)}\n{MARK}{after}")


if __name__ == "__main__":
    main()
