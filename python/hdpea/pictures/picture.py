# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of a mesh, drawn without a screen."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes.util import find_library
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.geometry.smooth_fans import CREASE
from hdpea.pictures.camera import choose_view, choose_view_of_points
from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import check_output, replacing

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


@contextmanager
def drawn_to(path: Path, **settings: Any) -> Iterator[tuple[ModuleType, Any]]:
    """Give pyvista and a white plotter; what it shows in the end is written to a PNG file, whole or not at all.

    Raises
    ------
    UsageError
        If nothing can be drawn on this machine, or the file cannot be written.
    """
    check_output(path, PICTURE_FORMATS)
    check_drawing()
    pyvista = load_pyvista()
    plotter = pyvista.Plotter(off_screen=True, **settings)
    try:
        plotter.background_color = pyvista.Color("white")
        yield pyvista, plotter
        with replacing(path) as partial:
            _save(partial, plotter.screenshot(return_img=True))
    finally:
        plotter.close()


def _save(path: Path, pixels: NDArray[np.uint8]) -> None:
    from PIL import Image
    from PIL.PngImagePlugin import PngInfo

    told = PngInfo()
    told.add_text("Software", mark_of("picture"))
    Image.fromarray(pixels).save(path, pnginfo=told)


def light_up(pyvista: ModuleType, plotter: Any) -> None:
    """Let light fall from above on the left, and smooth the edges of the picture."""
    plotter.add_light(pyvista.Light(position=(-0.7, 1.0, 2.0), light_type="scene light"))
    plotter.enable_anti_aliasing("ssaa")


def point_size(points: int, window: tuple[int, int]) -> float:
    """Return the width in pixels at which so many random points leave few gaps in a third of their window."""
    return float(np.clip(2.5 * (window[0] * window[1] / 3 / max(points, 1)) ** 0.5, 2, 40))


def look_at(plotter: Any, points: NDArray[np.float64], window: tuple[int, int]) -> None:
    """Let the camera look along -z at all of the points (n, 3)."""
    low, high = points.min(axis=0), points.max(axis=0)
    _look(plotter, (low + high) / 2, high - low, window)


def _look(plotter: Any, centre: NDArray[np.float64], size: NDArray[np.float64], window: tuple[int, int]) -> None:
    """Let the camera look along -z at a box of that centre (3,) and size (3,)."""
    x, y, z = centre
    plotter.camera_position = [(x, y, z + 2), (x, y, z), (0, 1, 0)]
    plotter.camera.parallel_projection = True
    plotter.camera.parallel_scale = MARGIN * max(size[1], size[0] * window[1] / window[0]) / 2


@dataclass(frozen=True)
class Camera:
    """Where to look from, and how much is seen: the same for several meshes of one thing.

    Attributes
    ----------
    view_from_world
        (3, 3) rotation: x to the right, y up, z towards the eye.
    centre_in_view, scale
        (3,), and a length in world units: the middle of what is seen, and what counts as 1.
    size
        (3,): of the box that is seen, in `scale`.
    """

    view_from_world: NDArray[np.float64]
    centre_in_view: NDArray[np.float64]
    scale: float
    size: NDArray[np.float64]

    @classmethod
    def before(
        cls,
        vertices: NDArray[np.float64],
        faces: NDArray[np.int64],
        sight: NDArray[np.float64] | None = None,
        up: str | None = None,
    ) -> Camera:
        """Look at a mesh (v, 3), (f, 3) obliquely, from the side that was scanned, as ``choose_view`` says."""
        return cls._towards(vertices, choose_view(vertices, faces, sight, up))

    @classmethod
    def before_points(cls, points: NDArray[np.float64], normals: NDArray[np.float64]) -> Camera:
        """Look at points (n, 3) with unit normals (n, 3) as at a mesh."""
        return cls._towards(points, choose_view_of_points(points, normals))

    @classmethod
    def _towards(cls, points: NDArray[np.float64], view_from_world: NDArray[np.float64]) -> Camera:
        in_view = points @ view_from_world.T
        low, high = in_view.min(axis=0), in_view.max(axis=0)
        scale = float(np.linalg.norm(high - low)) or 1.0
        return cls(view_from_world, (low + high) / 2, scale, (high - low) / scale)

    def to_view(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points (n, 3) of the world as the renderer takes them: in single precision, so centred, of size 1."""
        return (points @ self.view_from_world.T - self.centre_in_view) / self.scale


def draw_mesh(
    path: Path,
    vertices: NDArray[np.float64],
    faces: NDArray[np.int64],
    points: NDArray[np.float64] | None = None,
    size: tuple[int, int] = (1600, 1200),
    camera: Camera | None = None,
    colors: NDArray[np.uint8] | None = None,
) -> None:
    """Draw the surface with its edges, seen obliquely from the side that was scanned.

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
    camera
        Where to look from; by default as ``Camera.before`` chooses for the mesh alone.
    colors
        (v, 3), red, green and blue of the vertices, in place of the colour of the side and of the edges; the surface
        is shaded smoothly then, but for creases.

    Raises
    ------
    UsageError
        If nothing can be drawn on this machine, or the file cannot be written.
    """
    camera = camera or Camera.before(vertices, faces)
    if colors is None:
        looks = {
            "color": FRONT,
            "backface_params": {"color": BACK},
            "show_edges": True,
            "edge_color": EDGES,
            "line_width": 0.6,
        }
    else:
        shaded = {"smooth_shading": True, "split_sharp_edges": True, "feature_angle": CREASE}
        looks = {"scalars": colors, "rgb": True, **shaded}
    with drawn_to(path, window_size=list(size), lighting="none") as (pyvista, plotter):
        surface = pyvista.PolyData.from_regular_faces(camera.to_view(vertices), faces.astype(int))
        plotter.add_mesh(surface, ambient=0.3, diffuse=0.75, **looks)
        if points is not None:
            plotter.add_points(camera.to_view(points), color=DOTS, point_size=2)
        _look(plotter, np.zeros(3), camera.size, size)
        light_up(pyvista, plotter)


def draw_points(
    path: Path,
    points: NDArray[np.float64],
    colors: NDArray[np.uint8],
    size: tuple[int, int],
    camera: Camera,
) -> None:
    """Draw points (n, 3) in their colours (n, 3), red, green and blue, without light, large enough to leave few gaps.

    Parameters
    ----------
    path, size, camera
        As of ``draw_mesh``.

    Raises
    ------
    UsageError
        If nothing can be drawn on this machine, or the file cannot be written.
    """
    with drawn_to(path, window_size=list(size), lighting="none") as (_, plotter):
        width = point_size(len(points), size)
        plotter.add_points(camera.to_view(points), scalars=colors, rgb=True, point_size=width, lighting=False)
        _look(plotter, np.zeros(3), camera.size, size)
