# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of every command that makes them, driven in headless Chromium: the tables and the picture of docs/pages.md.

    pip install playwright && apt-get install chromium libcgal-demo
    python benchmarks/page_check.py build/pages docs/pages.md

Each page is opened from disk, on a phone's screen as well, and all of its panel is used: turned by the mouse, edges off
and on, the points, every colour, a second shape beside the first. What a page says on its console ends it, and so does
a step that changes no pixel. Pages that lie in OUT are not made again.
"""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterator
from pathlib import Path

import click
import numpy as np
from demo_data import CLOUDS, MODELS, demo_files
from numpy.typing import NDArray
from page_driver import DESK, PHONE, drive, opened, pixels
from PIL import Image
from playwright.sync_api import sync_playwright
from sheets import in_columns, save_jpeg, sheet, shrunk

from hdpea.cli import run
from hdpea.pages.colorings import mesh_shape, point_shape
from hdpea.pages.page import write_page

SUITE = """
title = "Two embeddings"
models = 1
points = 20_000
vertices = [1_000]
pictures = 1
[[input]]
name = "clean"
[[method]]
method = "hdpea"
[[method]]
name = "hdpea, learned"
method = "hdpea"
embedding = "learned"
"""

SIZES = {32: 30_000, 100: 100_000, 224: 200_000, 707: 0}
"""Points by squares along each side of a grid, of two triangles each."""

WITHOUT_GPU = ("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
SHOWN = {
    "reconstruct": "coloring=curvature&edges=0",
    "curvature": "second=",
    "benchmark": "edges=0",
    "view": "coloring=distance",
}
"""What the picture shows of each page."""

SMALL, LARGEST = (550, 350), 150_000


def hdpea(*words: object) -> None:
    """Run a command in this process."""
    if run([*map(str, words)]):
        raise click.ClickException(f"hdpea {words[0]} failed.")


def made(out: Path) -> dict[str, Path]:
    """Make a page by each command, and return them by its name."""
    pages = {name: out / f"{name}.html" for name in SHOWN}
    if all(page.exists() for page in pages.values()):
        return pages
    cloud, *_ = demo_files(out, CLOUDS, ["kitten.xyz"])
    demo_files(out / "meshes", MODELS, ["bull.off"])
    hdpea("reconstruct", cloud, out / "mesh.ply", "--page", pages["reconstruct"], "--force", "--quiet")
    hdpea("reconstruct", cloud, out / "few.ply", "--vertices", 200, "--force", "--quiet")
    hdpea("curvature", cloud, out / "k.npz", "--page", pages["curvature"], "--force", "--quiet")
    hdpea("view", out / "mesh.ply", out / "few.ply", cloud, "--page", pages["view"], "--force")
    (out / "suite.toml").write_text(SUITE)
    hdpea("benchmark", out / "suite.toml", out / "results", "--meshes", out / "meshes", "--page")
    page, *_ = (each for each in (out / "results").rglob("*.html") if each.name != "index.html")
    shutil.copy(page, pages["benchmark"])
    return pages


def size_rows(out: Path) -> Iterator[list[str]]:
    """Write pages of waves, and yield how large they are."""
    for side, count in SIZES.items():
        corners = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).reshape(-1, 1, 1)
        faces = (corners + np.array([[0, side + 1, side + 2], [0, side + 2, 1]])).reshape(-1, 3)
        vertices = _waves(*np.divmod(np.arange((side + 1) ** 2), side + 1), side)
        points = _waves(*np.random.default_rng(0).uniform(0, side, (2, count)), side)
        start = time.process_time()
        shapes = [mesh_shape("mesh", vertices, faces, points if count else None)]
        shapes += [point_shape("points", points, (vertices, faces))] if count else []
        write_page(out / f"waves{side}.html", "waves", shapes)
        seconds, size = time.process_time() - start, (out / f"waves{side}.html").stat().st_size
        yield [f"{len(faces):,}", f"{count:,}" if count else "none", f"{size / 1e6:.1f} MB", f"{seconds:.1f}"]


def _waves(x: NDArray[np.generic], y: NDArray[np.generic], side: int) -> NDArray[np.float64]:
    x, y = x / side, y / side
    return np.column_stack([x, y, 0.1 * np.sin(11 * x) * np.cos(14 * y)])


def table(titles: list[str], rows: list[list[str]]) -> str:
    """Return a table in Markdown."""
    lines = [titles, ["---"] * len(titles), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def replaced(text: str, mark: str, body: str) -> str:
    """Return a text with what stands between two marks written anew."""
    before, _, after = text.split(f"<!-- {mark} -->")
    return f"{before}<!-- {mark} -->\n{body}\n<!-- {mark} -->{after}"


@click.command()
@click.argument("out", type=click.Path(path_type=Path))
@click.argument("document", type=click.Path(exists=True, path_type=Path))
def main(*, out: Path, document: Path) -> None:
    """Make pages in OUT, drive them, and write the tables and the picture of DOCUMENT."""
    out.mkdir(parents=True, exist_ok=True)
    pages, rows, panels = made(out), [], []
    with sync_playwright() as playwright:
        program = shutil.which("chromium")
        browser = playwright.chromium.launch(executable_path=program, args=[*WITHOUT_GPU, "--no-sandbox"])
        for name, page in pages.items():
            for screen in (PHONE, DESK):
                with opened(browser, page, screen) as tab:
                    driven = drive(tab)
            with opened(browser, page, DESK, SHOWN[name]) as tab:
                panels.append((f"hdpea {name}", shrunk(Image.fromarray(pixels(tab)), SMALL)))
            size = f"{page.stat().st_size / 1e6:.1f} MB"
            counts = [f"{each:,}" for each in (driven.shapes, driven.triangles, driven.points)]
            rows.append([f"`hdpea {name}`", size, *counts, ", ".join(driven.colorings)])
    save_jpeg(sheet([*in_columns(panels, 2)], SMALL), document.with_suffix(".jpg"), LARGEST)
    of_commands = table(["page of", "file", "shapes", "triangles drawn", "points drawn", "colours"], rows)
    of_sizes = table(["faces", "points", "file", "CPU seconds to write"], [*size_rows(out)])
    text = replaced(document.read_text(), "commands", of_commands)
    document.write_text(replaced(text, "sizes", of_sizes))


if __name__ == "__main__":
    main()
