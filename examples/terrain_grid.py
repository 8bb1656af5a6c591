# SPDX-License-Identifier: GPL-3.0-or-later
"""From a mesh of terrain to a grid of heights that QGIS and GDAL open, an ESRI ASCII grid.

hdpea reconstruct tile.ply ground.obj --classes 2 --error 0.1
python examples/terrain_grid.py ground.obj terrain.asc --cell 0.5
"""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

from hdpea.reading.triangle_mesh import read_triangle_mesh

UNKNOWN = -9999.0


def heights_of(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    low: NDArray[np.float64],
    shape: tuple[int, int],
    cell: float,
) -> NDArray[np.float64]:
    """Return the height (rows, columns) of a mesh at the centres of cells from the corner `low` (2,) on, NaN outside.

    The highest counts, where there are several.
    """
    grid = np.full(shape, np.nan)
    centred = (vertices[:, :2] - low) / cell - 0.5  # in cells, so that the centres are whole numbers
    for corners in faces:
        (x, y), z = centred[corners].T, vertices[corners, 2]
        columns = np.arange(max(np.ceil(x.min()), 0), min(np.floor(x.max()), shape[1] - 1) + 1).astype(int)
        rows = np.arange(max(np.ceil(y.min()), 0), min(np.floor(y.max()), shape[0] - 1) + 1).astype(int)
        area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
        if not (len(columns) and len(rows) and area):
            continue
        u, v = np.meshgrid(columns - x[0], rows - y[0])
        second = (u * (y[2] - y[0]) - v * (x[2] - x[0])) / area
        third = (v * (x[1] - x[0]) - u * (y[1] - y[0])) / area
        inside = (second >= 0) & (third >= 0) & (second + third <= 1)
        height = np.where(inside, z[0] + second * (z[1] - z[0]) + third * (z[2] - z[0]), np.nan)
        block = np.ix_(rows, columns)
        grid[block] = np.fmax(grid[block], height)
    return grid


def cropped(
    grid: NDArray[np.float64], low: NDArray[np.float64], cell: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a grid, and its corner, without the rows and columns at its rim in which nothing is known."""
    known = np.argwhere(np.isfinite(grid))
    if not len(known):
        raise click.ClickException("No centre of a cell lies on the mesh: choose smaller cells.")
    first, last = known.min(axis=0), known.max(axis=0) + 1
    return grid[first[0] : last[0], first[1] : last[1]], low + cell * first[::-1]


@click.command()
@click.argument("mesh", type=click.Path(path_type=Path))
@click.argument("out", type=click.Path(path_type=Path))
@click.option("--cell", default=1.0, show_default=True, help="size of a cell, in the units of the mesh")
def main(mesh: Path, out: Path, cell: float) -> None:
    """Write the heights of the terrain MESH to OUT."""
    vertices, faces = read_triangle_mesh(mesh)
    # Corners are multiples of the cell, so that the grids of neighbouring tiles fit together.
    low = cell * np.floor(vertices[:, :2].min(axis=0) / cell)
    columns, rows = np.ceil((vertices[:, :2].max(axis=0) - low) / cell).astype(int)
    grid, low = cropped(heights_of(vertices, faces, low, (rows, columns), cell), low, cell)
    corner = f"xllcorner {low[0]}\nyllcorner {low[1]}"
    head = f"ncols {grid.shape[1]}\nnrows {len(grid)}\n{corner}\ncellsize {cell}\nnodata_value {UNKNOWN}"
    # From north to south.
    np.savetxt(out, np.nan_to_num(grid[::-1], nan=UNKNOWN), fmt="%.4f", header=head, comments="")
    print(f"{len(faces)} faces -> {len(grid)} x {grid.shape[1]} cells, {np.isfinite(grid).mean():.0%} of them known")


if __name__ == "__main__":
    main()
