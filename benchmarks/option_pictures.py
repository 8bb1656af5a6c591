# SPDX-License-Identifier: GPL-3.0-or-later
"""What options of `hdpea reconstruct` change, on two clouds of Debian's libcgal-demo: docs/commands/options.jpg.

    python benchmarks/option_pictures.py docs/commands/options.jpg

A mesh that is not as asked for ends it: a picture must not show what an option did not do.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import click
from PIL import Image, ImageDraw, ImageFont
from raw_gallery import demo_clouds

from hdpea.pictures.picture import Camera, draw_mesh
from hdpea.reading.triangle_mesh import read_triangle_mesh

KITTEN = ["", "--faces 400", "--error 1%", "--vertices 300 --max-stretch 1", "--vertices 300 --metric-scale 2"]
HOUSE = ["", "--faces 300", "--error 2%", "--watertight", "--outliers none"]
SHOWN = {"kitten.xyz": KITTEN, "point_set_3.xyz": HOUSE}
"""Options by cloud; the first are the defaults, whose mesh says where the camera stands."""

TILE, LINE, QUALITY = (380, 320), 28, 82


def draw_row(sheet: Image.Image, top: int, cloud: Path, options: list[str]) -> None:
    """Draw the meshes of a cloud side by side, with what was said to the command, and how many triangles it made."""
    draw, font = ImageDraw.Draw(sheet), ImageFont.load_default(17)
    camera = None
    for place, words in enumerate(options):
        mesh, panel = cloud.with_suffix(".mesh.ply"), cloud.with_suffix(".png")
        command = [sys.executable, "-m", "hdpea", "reconstruct", str(cloud), str(mesh), "--quiet", *words.split()]
        subprocess.run(command, check=True)
        vertices, faces = read_triangle_mesh(mesh)
        camera = camera or Camera.before(vertices, faces)
        draw_mesh(panel, vertices, faces, size=TILE, camera=camera)
        left = place * TILE[0]
        with Image.open(panel) as picture:
            sheet.paste(picture.convert("RGB"), (left, top))
        said = f"{words or 'default'}: {len(faces):,}"
        draw.text((left + TILE[0] / 2, top + TILE[1] + LINE / 2), said, fill="black", font=font, anchor="mm")


@click.command()
@click.argument("picture", type=click.Path(path_type=Path))
def main(*, picture: Path) -> None:
    """Draw PICTURE."""
    height = TILE[1] + LINE
    sheet = Image.new("RGB", (TILE[0] * max(map(len, SHOWN.values())), height * len(SHOWN)), "white")
    with TemporaryDirectory() as folder:
        clouds = {path.name: path for path in demo_clouds(Path(folder))}
        for row, (name, options) in enumerate(SHOWN.items()):
            draw_row(sheet, row * height, clouds[name], options)
    sheet.save(picture, quality=QUALITY, optimize=True)


if __name__ == "__main__":
    main()
