# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of clouds beside their meshes, all from one viewpoint, and a sheet of many."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from gallery_measures import Known
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from hdpea.pictures.picture import Camera, draw_mesh, draw_points

Mesh = tuple[NDArray[np.float64], NDArray[np.int64]]

PANEL = (640, 480)
"""Width and height of each, in pixels."""

ON_SHEET = (200, 150)
"""The same on the sheet."""

COLUMNS = 2
"""Clouds beside each other on the sheet."""

LARGEST = 400_000
"""Bytes of a sheet."""

LIGHT = np.array([-0.4, 0.6, 0.7])
"""Direction towards the light, in the frame of the view."""


def draw_cloud(path: Path, title: str, known: Known, meshes: Mapping[str, Mesh | None]) -> None:
    """Draw the points of a cloud, lit by their normals, and every mesh of it; nothing where there is none."""
    points = known.frame.to_world(known.points)
    camera = Camera.before_points(points, known.normals)
    shades = shades_of(known.normals, camera)
    row = Image.new("RGB", (PANEL[0] * (1 + len(meshes)), PANEL[1]), "white")
    with TemporaryDirectory() as folder:
        panel = Path(folder) / "panel.png"
        draw_points(panel, points, shades, PANEL, camera)
        _paste(row, panel, 0, title)
        for place, (name, mesh) in enumerate(meshes.items(), 1):
            if mesh is not None:
                draw_mesh(panel, *mesh, size=PANEL, camera=camera)
            _paste(row, panel if mesh is not None else None, place, name)
    row.save(path, optimize=True)


def shades_of(normals: NDArray[np.float64], camera: Camera) -> NDArray[np.uint8]:
    """Return colours (n, 3) of points with normals (n, 3), as the light falls on them, whichever side is out."""
    brightness = abs(normals @ camera.view_from_world.T @ LIGHT).clip(0.25, 1)
    return np.rint(brightness[:, None] * [150, 170, 205]).astype(np.uint8)


def _paste(row: Image.Image, panel: Path | None, place: int, title: str) -> None:
    left = place * PANEL[0]
    if panel is not None:
        with Image.open(panel) as drawn:
            row.paste(drawn, (left, 0))
    ImageDraw.Draw(row).text((left + 8, 4), title, fill="black", font_size=26)


def draw_sheet(path: Path, pictures: Sequence[Path]) -> None:
    """Put pictures of clouds, all with as many panels, on one sheet of at most ``LARGEST`` bytes."""
    if not pictures:
        return
    with Image.open(pictures[0]) as first:
        width = first.width // PANEL[0] * ON_SHEET[0]
    rows = -(-len(pictures) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * width, rows * ON_SHEET[1]), "white")
    for place, picture in enumerate(pictures):
        with Image.open(picture) as drawn:
            corner = place % COLUMNS * width, place // COLUMNS * ON_SHEET[1]
            sheet.paste(drawn.resize((width, ON_SHEET[1]), Image.Resampling.LANCZOS), corner)
    for quality in range(90, 20, -5):
        sheet.save(path, quality=quality, optimize=True)
        if path.stat().st_size <= LARGEST:
            break
