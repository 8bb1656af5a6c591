# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of curvature tensors as ellipsoids, drawn without a screen."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.curvature.glyphs import Glyphs, glyphs_of
from hdpea.curvature.tensors import CurvatureTensors
from hdpea.outputs import check_output, replacing
from hdpea.picture import PICTURE_FORMATS, check_drawing, load_pyvista, look_at, point_size
from hdpea.viewpoint import choose_view_of_points

GLYPHS = 4_000

SURFACE = "#f2f2f2"
"""Colour of the points below."""

SIDES = 12
"""Of the polygon around a glyph."""


def draw_curvature(path: Path, tensors: CurvatureTensors, size: tuple[int, int] = (1600, 1200)) -> None:
    """Draw tensors as ellipsoids on the points, coloured by stretching ratio: blue where 1, red where 4 or more.

    Those along the surface's smaller curvature are long; where the directions are not determined they are round and
    grey (paper, section 4.3).

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
    check_output(path, PICTURE_FORMATS)
    check_drawing()
    pyvista = load_pyvista()
    glyphs = glyphs_of(tensors, GLYPHS)
    points = glyphs.frame.to_unit(tensors.points)
    view_from_unit = choose_view_of_points(points, tensors.normals)
    in_view = points @ view_from_unit.T
    # Points hide nothing behind them: those of the far side are left out.
    facing = (tensors.normals @ view_from_unit.T)[:, 2] > 0
    vertices, faces, colors = _ellipsoids(glyphs, pyvista.Sphere(theta_resolution=SIDES, phi_resolution=SIDES // 2 + 1))

    plotter = pyvista.Plotter(off_screen=True, window_size=list(size), lighting="none")
    plotter.background_color = pyvista.Color("white")
    pixels = point_size(int(facing.sum()), size)
    depth = pixels * np.ptp(in_view[:, 1]) / size[1]
    plotter.add_points(
        in_view[facing] - [0, 0, depth], color=SURFACE, point_size=pixels, render_points_as_spheres=True, ambient=0.3
    )
    mesh = pyvista.PolyData.from_regular_faces(vertices @ view_from_unit.T, faces)
    plotter.add_mesh(mesh, scalars=colors, rgb=True, smooth_shading=True, ambient=0.35, diffuse=0.75)
    look_at(plotter, in_view, size)
    plotter.add_light(pyvista.Light(position=(-0.7, 1.0, 2.0), light_type="scene light"))
    plotter.enable_anti_aliasing("ssaa")
    with replacing(path) as partial:
        plotter.screenshot(partial)
    plotter.close()


def _ellipsoids(glyphs: Glyphs, sphere: object) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.uint8]]:
    """Return vertices (v, 3), triangles (f, 3) and vertex colours (v, 3) of copies of a sphere, one for each glyph."""
    unit = 2 * np.asarray(sphere.points, dtype=np.float64)  # type: ignore[attr-defined] # its radius is a half
    triangles = np.asarray(sphere.regular_faces, dtype=np.int64)  # type: ignore[attr-defined]
    vertices = glyphs.centres[:, None] + np.einsum("va,mai->mvi", unit, glyphs.axes)
    faces = triangles + len(unit) * np.arange(len(glyphs.centres))[:, None, None]
    return vertices.reshape(-1, 3), faces.reshape(-1, 3), np.repeat(glyphs.colors, len(unit), axis=0)
