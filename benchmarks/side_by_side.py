# SPDX-License-Identifier: GPL-3.0-or-later
"""Several meshes of the same object in one picture, such as those of a suite for one model.

    python benchmarks/side_by_side.py build/results/tangents/meshes/clean/adis16480/*.ply docs/tangents.png

The first mesh determines the viewpoint.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from hdpea.pictures.picture import Camera, draw_mesh
from hdpea.reading.triangle_mesh import read_triangle_mesh

PANEL = (320, 320)
"""Width and height of each, in pixels."""

COLORS = 64
"""Colours in the picture, which keep it small."""


def draw_side_by_side(path: Path, meshes: Sequence[tuple[NDArray[np.float64], NDArray[np.int64]]]) -> None:
    """Draw meshes (vertices, faces) from left to right, all from the viewpoint chosen for the first."""
    camera = Camera.before(*meshes[0])
    row = Image.new("RGB", (PANEL[0] * len(meshes), PANEL[1]))
    with TemporaryDirectory() as folder:
        for place, mesh in enumerate(meshes):
            panel = Path(folder) / f"{place}.png"
            draw_mesh(panel, *mesh, size=PANEL, camera=camera)
            with Image.open(panel) as drawn:
                row.paste(drawn, (place * PANEL[0], 0))
    path.parent.mkdir(parents=True, exist_ok=True)
    row.quantize(COLORS).save(path, optimize=True)


@click.command()
@click.argument("meshes", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path))
@click.argument("picture", type=click.Path(path_type=Path))
def main(*, meshes: tuple[Path, ...], picture: Path) -> None:
    """Draw MESHES from left to right in PICTURE, all from the viewpoint chosen for the first."""
    draw_side_by_side(picture, [read_triangle_mesh(each) for each in meshes])


if __name__ == "__main__":
    main()
