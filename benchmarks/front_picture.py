# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of the README: a raw cloud, the mesh that is usually made of it, and ours with as many triangles.

    pip install open3d && apt-get install libcgal-demo
    python benchmarks/front_picture.py docs/front.png

The cloud is point_set_3.xyz of Debian's libcgal-demo, a house and some ground around it. Its normals are given to
neither method. Prints what each mesh is like.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import click
import numpy as np
from gallery_measures import Known, mesh_measures
from gallery_pictures import shades_of
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from plain_pipeline import plain_mesh
from raw_gallery import demo_clouds

from hdpea import _core, read_points, reconstruct
from hdpea.pictures.picture import Camera, draw_mesh, draw_points

CLOUD = "point_set_3.xyz"
FACES = 600
PANEL = (620, 470)
"""Width and height of each of six, in pixels."""

CAPTION = 40
"""Height of the line above, in pixels."""

CLOSER = 3.0
"""Times that the lower row is nearer."""

LOOKED_AT = (0.08, -0.1)
"""What that row shows the middle of, from the middle of the picture, in diagonals of what is seen: a gable's corner."""

COLORS = 64
"""In the file: of the few that there are."""

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]


def drawn(
    points: NDArray[np.float64], normals: NDArray[np.float64], meshes: list[Mesh], camera: Camera
) -> list[Image.Image]:
    """Draw points (n, 3), shaded by normals (n, 3), and the meshes from one place."""
    pictures = []
    with TemporaryDirectory() as folder:
        panel = Path(folder) / "panel.png"
        for mesh in (None, *meshes):
            if mesh is None:
                twice = 2 * PANEL[0], 2 * PANEL[1]  # and then smaller, which rounds the dots
                draw_points(panel, points, shades_of(normals, camera), twice, camera)
            else:
                draw_mesh(panel, *mesh, size=PANEL, camera=camera)
            with Image.open(panel) as picture:
                pictures.append(picture.convert("RGB").resize(PANEL, Image.Resampling.LANCZOS))
    return pictures


def sheet(rows: list[list[Image.Image]], captions: list[str]) -> Image.Image:
    """Put rows of panels below captions."""
    width, height = PANEL
    whole = Image.new("RGB", (width * len(captions), CAPTION + height * len(rows)), "white")
    draw = ImageDraw.Draw(whole)
    font = ImageFont.load_default(26)
    for column, caption in enumerate(captions):
        draw.text((width * (column + 0.5), CAPTION / 2), caption, fill="#1f2937", font=font, anchor="mm")
        for row, panels in enumerate(rows):
            whole.paste(panels[column], (width * column, CAPTION + height * row))
    return whole


@click.command()
@click.argument("picture", type=click.Path(path_type=Path))
def main(*, picture: Path) -> None:
    """Draw PICTURE."""
    with TemporaryDirectory() as folder:
        path = next(each for each in demo_clouds(Path(folder)) if each.name == CLOUD)
        points, cloud = read_points(path).points, Known.of(path)
    plain = plain_mesh(points, FACES)
    made = reconstruct(points, faces=FACES)
    ours = made.vertices, made.faces
    for name, mesh in {"plain": plain, "hdpea": ours}.items():
        measures = mesh_measures(*mesh, cloud)
        click.echo(f"{name}: {len(mesh[1])} triangles, {measures}")
    camera = Camera.before(*ours)
    aside = np.array([*LOOKED_AT, 0]) * camera.scale
    closer = replace(camera, centre_in_view=camera.centre_in_view + aside, size=camera.size / CLOSER)
    captions = [
        f"{len(points):,} raw points",
        f"clean, Poisson, trim, collapse: {len(plain[1])} triangles",
        f"hdpea: {len(made.faces)} triangles",
    ]
    nearest = _core.nearest_neighbors(cloud.points, cloud.frame.to_unit(points), 1)[:, 0]  # strays have no normals
    rows = [drawn(points, cloud.normals[nearest], [plain, ours], each) for each in (camera, closer)]
    sheet(rows, captions).quantize(COLORS, dither=Image.Dither.NONE).save(picture, optimize=True)


if __name__ == "__main__":
    main()
