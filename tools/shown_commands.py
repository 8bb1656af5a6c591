# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands that the README and docs/ show, run as they stand there.

    python tools/shown_commands.py [PAGE ...]

Each page's commands run in a folder of its own, in their order, with small clouds and meshes of the names that pages
use. Those that take hours, or change the machine, do not run: ``NOT_RUN`` says which, and why. Even so a test checks
their flags.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import click
import laspy
import numpy as np
import trimesh
from command_pages import context_of
from plyfile import PlyData, PlyElement

from hdpea import write_mesh

ROOT = Path(__file__).parents[1]
PAGES = ["README.md", *sorted(str(each.relative_to(ROOT)) for each in (ROOT / "docs").rglob("*.md"))]

NOT_RUN = {
    r"(python3 -m venv|pip|make|cmake|apt-get) ": "installs or builds; docs/releasing.md says what was tried",
    r"\.venv/bin/python benchmarks/": "hours, and meshes that are not in the repository",
    r"hdpea (benchmark|train) ": "hours, and other methods; their tests have small ones",
    r"torchrun ": "hours",
    r"(\.venv/bin/python examples/shapes\.py|hdpea reconstruct) knot[. ]": "ten million points",
}
"""Commands that are not run, by how they begin, and why."""

BLOCK = re.compile(r"^```console\n(.*?)^```", re.DOTALL | re.MULTILINE)
FEW, MANY = 2_000, 12_000
"""Points of the clouds: enough for most commands, and for those that ask for 5,000 vertices."""


def shown(page: str) -> list[str]:
    """Return the commands of a page's console blocks, in their order, without prompts and comments."""
    text = "".join(BLOCK.findall((ROOT / page).read_text())).replace("\\\n", "")
    return [re.sub(r"\s+#\s.*", "", line[2:]).strip() for line in text.splitlines() if line.startswith("$ ")]


def reason_not_to_run(command: str) -> str | None:
    """Return why a command is not run, if it is not."""
    return next((why for begin, why in NOT_RUN.items() if re.match(begin, command)), None)


def check(command: str) -> None:
    """Make sure that all that a line says to hdpea is what hdpea understands; run nothing.

    Raises
    ------
    click.UsageError
        If there is no such command, flag or value.
    """
    for arguments in _calls_of_hdpea(command):
        depth = 2 if arguments[1:2] == ["dataset"] else 1
        context = context_of(" ".join(["hdpea", *arguments[1 : 1 + depth]]))
        context.command.make_context(context.info_name, arguments[1 + depth :], parent=context.parent)


def _calls_of_hdpea(command: str) -> Iterator[list[str]]:
    """Yield the words of each call of hdpea in a line, without what only the shell reads."""
    for part in re.split(r"\||&&|;", command):
        words = shlex.split(re.sub(r"\s\d?>>?\s*\S+", "", part), comments=True)
        words = words[1:] if words[:1] == ["time"] else words
        if words[:1] == ["hdpea"] and not words[1].startswith("-"):
            yield words


def prepare(folder: Path, count: int) -> None:
    """Make the files that pages name: clouds of so many points of an ellipsoid, balls as meshes, and `hdpea` itself."""
    random = np.random.default_rng(0)
    normals = random.standard_normal((count, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points = normals * [2, 1, 1]
    for name in ("scan.ply", "a.ply", "fused.ply", "front.ply", "back.ply", "tile.ply", "statue.ply"):
        _write_cloud(folder / name, points)
    for name in ("flight.laz", "survey.laz"):
        _write_laz(folder / name, points)
    for name in ("scan.xyz", "b.xyz"):
        np.savetxt(folder / name, points)
    (folder / "c.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in points))
    ball = trimesh.creation.icosphere(subdivisions=3)
    for directory in ("meshes", "MESHES"):
        (folder / directory).mkdir()
        ball.export(folder / directory / "bunny.ply")
    ball.export(folder / "bunny.ply")
    ball.export(folder / "true.ply")
    for name in ("mesh.obj", "other.obj"):  # as hdpea makes them, so that it may make them again
        write_mesh(folder / name, np.asarray(ball.vertices), np.asarray(ball.faces))
    (folder / ".config/fish/completions").mkdir(parents=True)
    (folder / "programs").mkdir()
    program = folder / "programs/hdpea"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m hdpea "$@"\n')
    program.chmod(0o755)


def _write_cloud(path: Path, points: np.ndarray[Any, np.dtype[np.float64]]) -> None:
    """Write a PLY of red points, of class 2."""
    columns: dict[str, Any] = dict(zip("xyz", points.T, strict=True))
    columns |= {"red": 200, "green": 20, "blue": 10, "classification": 2}
    table = np.empty(len(points), [(name, "f8" if name in "xyz" else "u1") for name in columns])
    for name, values in columns.items():
        table[name] = values
    PlyData([PlyElement.describe(table, "vertex")]).write(path)


def _write_laz(path: Path, points: np.ndarray[Any, np.dtype[np.float64]]) -> None:
    """Write a LAZ of points of class 2, to the millimetre."""
    las = laspy.LasData(laspy.LasHeader(point_format=6, version="1.4"))
    las.header.scales = [0.001] * 3
    las.x, las.y, las.z = points.T
    las.classification = np.full(len(points), 2, np.uint8)
    las.write(path)


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a command in a folder that was prepared; no browser opens, and the folder is the home."""
    path = os.pathsep.join([str(folder / "programs"), os.environ["PATH"]])
    environment = {**os.environ, "PATH": path, "HOME": str(folder), "BROWSER": "true"}
    shell = ["/bin/bash", "-ec", command]  # bash, which has `time`
    return subprocess.run(shell, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def run_page(page: str, count: int = MANY) -> list[str]:
    """Run the commands of a page on clouds of so many points; return what went wrong."""
    wrong = []
    with TemporaryDirectory() as name:
        folder = Path(name)
        prepare(folder, count)
        for command in shown(page):
            why = reason_not_to_run(command)
            click.echo(f"{page}: {command}" + (f"\n    not run: {why}" if why else ""))
            if why is None and (ended := run(command, folder)).returncode:
                wrong.append(f"{page}: {command}\n    exit {ended.returncode}: {ended.stderr.strip()}")
    return wrong


def main() -> None:
    """Run the pages named, or all of them."""
    wrong = [each for page in sys.argv[1:] or PAGES for each in run_page(page)]
    click.echo("\n".join(["", *wrong, f"{len(wrong)} commands failed."]))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
