# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of curvature tensors as ellipsoids, drawn without a screen."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.curvature.glyphs import PLATE, glyphs_of
from hdpea.curvature.tensors import CurvatureTensors
from hdpea.pictures.camera import choose_view_of_points
from hdpea.pictures.picture import drawn_to, light_up, look_at

Rows = NDArray[np.float64]

GLYPHS = 4_000

SURFACE = "#f4f4f4"
"""Colour of the disks below the glyphs."""

SIDES = 12
"""Of the polygons that stand for circles."""


def draw_curvature(path: Path, tensors: CurvatureTensors, size: tuple[int, int] = (1600, 1200)) -> None:
    """Draw tensors as ellipsoids on the points, coloured by stretching ratio: blue where 1, red where largest.

    They are long in the direction of the smaller curvature, and round and grey where the directions are not determined
    (as in the HD-PEA paper, appendix G).

    Parameters
    ----------
    path
        A PNG file, replaced only once the new one is complete.
    size
        Width and height in pixels.

    Raises
    ------
    UsageError
        If nothing can be drawn on this machine, or the file cannot be written.
    """
    glyphs = glyphs_of(tensors, GLYPHS)
    view_from_unit = choose_view_of_points(glyphs.centres, glyphs.normals)
    # As on the HTML page: the far side would show through the gaps between the disks.
    facing = (glyphs.normals @ view_from_unit.T)[:, 2] > 0
    centres, axes = glyphs.centres[facing], glyphs.axes[facing]
    with drawn_to(path, window_size=list(size), lighting="none") as (pyvista, plotter):
        ball = pyvista.Sphere(radius=1, theta_resolution=SIDES, phi_resolution=SIDES // 2 + 1)
        disk = pyvista.Disc(inner=0, outer=PLATE, r_res=1, c_res=SIDES).triangulate()
        vertices, faces = _copies(disk, centres, _plates(axes, glyphs.radius))
        surface = pyvista.PolyData.from_regular_faces(vertices @ view_from_unit.T, faces)
        plotter.add_mesh(surface, color=SURFACE, ambient=0.45, diffuse=0.55)
        vertices, faces = _copies(ball, centres, axes)
        ellipsoids = pyvista.PolyData.from_regular_faces(vertices @ view_from_unit.T, faces)
        colors = np.repeat(glyphs.colors[facing], ball.n_points, axis=0)
        plotter.add_mesh(ellipsoids, scalars=colors, rgb=True, smooth_shading=True, ambient=0.35, diffuse=0.75)
        look_at(plotter, glyphs.centres @ view_from_unit.T, size)
        middle, most = f"{glyphs.most**0.5:.2g}", f"{glyphs.most:.2g}"
        legend = f" stretching ratio: blue 1, pale {middle}, red {most} and more; dark grey: any direction"
        plotter.add_text(legend, position="lower_left", color="black", font_size=size[1] // 100)
        light_up(pyvista, plotter)


def _plates(axes: Rows, radius: float) -> Rows:
    """Return half axes (m, 3, 3) of the same directions, all of length `radius`."""
    return np.asarray(radius * axes / np.linalg.norm(axes, axis=2, keepdims=True))


def _copies(shape: Any, centres: Rows, axes: Rows) -> tuple[Rows, NDArray[np.int64]]:
    """Return the vertices (v, 3) and triangles (f, 3) of copies of a pyvista mesh, one in each of the frames."""
    unit = np.asarray(shape.points, dtype=np.float64)
    triangles = np.asarray(shape.regular_faces, dtype=np.int64)
    vertices = centres[:, None] + np.einsum("va,mai->mvi", unit, axes)
    faces = triangles + len(unit) * np.arange(len(centres))[:, None, None]
    return vertices.reshape(-1, 3), faces.reshape(-1, 3)
