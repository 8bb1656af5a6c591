# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of a mesh, drawn without a screen."""

from __future__ import annotations

import os
import sys
from ctypes.util import find_library
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.outputs import check_output, replacing
from hdpea.viewpoint import choose_view

PICTURE_FORMATS = (".png",)
FRONT, BACK, EDGES, DOTS = "#d3deed", "#e9bd90", "#33415c", "#c2410c"
MARGIN = 1.04


def check_drawing() -> None:
    """Make sure that a picture can be drawn on this machine.

    Raises
    ------
    UsageError
        If pyvista, or a way to draw without a screen, is missing.
    """
    if find_spec("pyvista") is None:
        raise UsageError("Cannot draw a picture: pyvista is not installed.", "pip install 'hdpea[picture]'")
    if not _has_screen() and not (find_library("OSMesa") or find_library("EGL")):
        raise UsageError(
            "Cannot draw a picture: there is neither a screen nor a library that draws without one.",
            "On Debian and Ubuntu: apt-get install libosmesa6",
        )


def _has_screen() -> bool:
    return sys.platform != "linux" or "DISPLAY" in os.environ


def load_pyvista() -> ModuleType:
    """Return pyvista, set to draw without a screen where there is none; ``check_drawing`` first."""
    if not _has_screen() and find_library("OSMesa"):
        # Must be said before VTK is imported; it would try a display first.
        os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")
    return import_module("pyvista")


def draw_mesh(
    path: Path,
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    points: NDArray[np.float64] | None = None,
    size: tuple[int, int] = (1600, 1200),
) -> None:
    """Draw the surface with its edges, seen obliquely from the side that most of it faces.

    Back sides are drawn in another colour, so that open and inverted parts show.

    Parameters
    ----------
    path
        A PNG file, replaced only once the new one is complete.
    vertices, faces
        The mesh, (v, 3) and (f, 3), f > 0.
    points
        (n, 3) to be drawn as dots, for comparison.
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
    view_from_world = choose_view(vertices, faces)
    # The renderer works in single precision: what it gets is centred and of size 1.
    in_view = vertices @ view_from_world.T
    low, high = in_view.min(axis=0), in_view.max(axis=0)
    center, scale = (low + high) / 2, np.linalg.norm(high - low) or 1.0

    plotter = pyvista.Plotter(off_screen=True, window_size=list(size), lighting="none")
    plotter.background_color = pyvista.Color("white")
    plotter.add_mesh(
        pyvista.PolyData.from_regular_faces((in_view - center) / scale, faces.astype(int)),
        color=FRONT,
        backface_params={"color": BACK},
        show_edges=True,
        edge_color=EDGES,
        line_width=0.6,
        ambient=0.3,
        diffuse=0.75,
    )
    if points is not None:
        plotter.add_points((points @ view_from_world.T - center) / scale, color=DOTS, point_size=2)
    plotter.camera_position = [(0, 0, 2), (0, 0, 0), (0, 1, 0)]
    width, height, _ = (high - low) / scale
    plotter.camera.parallel_projection = True
    plotter.camera.parallel_scale = MARGIN * max(height, width * size[1] / size[0]) / 2
    plotter.add_light(pyvista.Light(position=(-0.7, 1.0, 2.0), light_type="scene light"))
    plotter.enable_anti_aliasing("ssaa")
    with replacing(path) as partial:
        plotter.screenshot(partial)
    plotter.close()
