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
from demo_data import CLOUDS, demo_files
from gallery_measures import Known, mesh_measures
from plain_pipeline import plain_mesh
from sheets import mesh_picture, points_picture, save_png, sheet

from hdpea import _core, read_points, reconstruct
from hdpea.pictures.picture import Camera

CLOUD = "point_set_3.xyz"
FACES = 600
PANEL = (620, 470)
"""Width and height of each of six, in pixels."""

CLOSER = 3.0
"""Times that the lower row is nearer."""

LOOKED_AT = (0.08, -0.1)
"""What that row shows the middle of, from the middle of the picture, in diagonals of what is seen: a gable's corner."""


@click.command()
@click.argument("picture", type=click.Path(path_type=Path))
def main(*, picture: Path) -> None:
    """Draw PICTURE."""
    with TemporaryDirectory() as folder:
        path, *_ = demo_files(Path(folder), CLOUDS, [CLOUD])
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
    rows = []
    for place, words in ((camera, captions), (closer, [""] * 3)):
        pictures = [points_picture(points, cloud.normals[nearest], PANEL, place)]
        pictures += [mesh_picture(mesh, PANEL, place) for mesh in (plain, ours)]
        rows.append([*zip(words, pictures, strict=True)])
    save_png(sheet(rows, PANEL, font_size=26), picture)


if __name__ == "__main__":
    main()
