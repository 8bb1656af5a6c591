# SPDX-License-Identifier: GPL-3.0-or-later
"""What counts as noise: roughness of points of true surfaces, with and without noise.

    python benchmarks/roughness_table.py FOLDER

The meshes of FOLDER are sampled (40,000 points); noise is in shares of the diagonal. Prints Markdown: the
roughness of the points in their spacings, on how many meshes it is distributed like noise, and on how many the points
would be denoised if normals are given.
"""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np

from hdpea.dataset.discovery import find_meshes
from hdpea.dataset.surface_file import read_surface
from hdpea.frontend.roughness import roughness_of
from hdpea.geometry.sampling import sample_surface
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options.denoising import ROUGH

NOISE = (0.0, 0.0005, 0.001, 0.003, 0.005)


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path))
@click.option("--points", default=40_000, show_default=True)
def main(*, folder: Path, points: int) -> None:
    """Print the roughness of points of the meshes of FOLDER."""
    surfaces = [read_surface(source.path) for source in find_meshes(str(folder))]
    drawn = [
        sample_surface(UnitFrame.around(vertices).to_unit(vertices), faces, points).points
        for vertices, faces in surfaces
    ]
    click.echo(f"| noise | median roughness | like noise, of {len(drawn)} | denoised |\n|---|---|---|---|")
    for noise in NOISE:
        random = np.random.default_rng(0)
        found = [roughness_of(cloud + noise * random.standard_normal(cloud.shape)) for cloud in drawn]
        like, denoised = sum(each.like_noise for each in found), sum(each.noise > ROUGH for each in found)
        click.echo(f"| {noise:.2%} | {np.median([each.deviation for each in found]):.3f} | {like} | {denoised} |")


if __name__ == "__main__":
    main()
