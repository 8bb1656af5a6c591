# SPDX-License-Identifier: GPL-3.0-or-later
"""Several meshes of the same object in one picture, such as those of a suite for one model.

    python benchmarks/side_by_side.py build/results/tangents/meshes/clean/adis16480/*.ply docs/tangents.png

The first mesh determines the viewpoint.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click
from sheets import Mesh, mesh_picture, save_png, sheet

from hdpea.pictures.picture import Camera
from hdpea.reading.triangle_mesh import read_triangle_mesh

PANEL = (320, 320)
"""Width and height of each, in pixels."""


def draw_side_by_side(path: Path, meshes: Sequence[Mesh]) -> None:
    """Draw meshes (vertices, faces) from left to right, all from the viewpoint chosen for the first."""
    camera = Camera.before(*meshes[0])
    save_png(sheet([[("", mesh_picture(mesh, PANEL, camera)) for mesh in meshes]], PANEL), path)


@click.command()
@click.argument("meshes", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path))
@click.argument("picture", type=click.Path(path_type=Path))
def main(*, meshes: tuple[Path, ...], picture: Path) -> None:
    """Draw MESHES from left to right in PICTURE, all from the viewpoint chosen for the first."""
    draw_side_by_side(picture, [read_triangle_mesh(each) for each in meshes])


if __name__ == "__main__":
    main()
