# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of meshes and points as panels, and panels in rows on one sheet, each below its caption."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from hdpea.pictures.picture import Camera, draw_mesh, draw_points

Mesh: TypeAlias = tuple[NDArray[np.float64], NDArray[np.int64]]
Panel: TypeAlias = tuple[str, Image.Image | None]
"""A caption and a picture; None leaves its place white."""

Size: TypeAlias = tuple[int, int]
"""Width and height, in pixels."""

LIGHT = np.array([-0.4, 0.6, 0.7])
"""Direction towards the light, in the frame of the view."""

INK = "#1f2937"
QUALITIES = range(85, 20, -5)
"""Of a JPEG, from the best."""


def mesh_picture(mesh: Mesh, size: Size, camera: Camera | None = None) -> Image.Image:
    """Draw a mesh (v, 3), (f, 3), from where a run would look at it if no camera is given."""
    return _drawn(lambda path: draw_mesh(path, *mesh, size=size, camera=camera))


def points_picture(
    points: NDArray[np.float64], normals: NDArray[np.float64], size: Size, camera: Camera
) -> Image.Image:
    """Draw points (n, 3), lit by their normals (n, 3), whichever side is out."""
    brightness = abs(normals @ camera.view_from_world.T @ LIGHT).clip(0.25, 1)
    shades = np.rint(brightness[:, None] * [150, 170, 205]).astype(np.uint8)
    twice = 2 * size[0], 2 * size[1]  # and then smaller, which rounds the dots
    return shrunk(_drawn(lambda path: draw_points(path, points, shades, twice, camera)), size)


def _drawn(draw: Callable[[Path], None]) -> Image.Image:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "panel.png"
        draw(path)
        return opened(path)


def opened(path: Path) -> Image.Image:
    """Read a picture, in red, green and blue."""
    with Image.open(path) as picture:
        return picture.convert("RGB")


def shrunk(picture: Image.Image, size: Size) -> Image.Image:
    """Return a picture at another size."""
    return picture.resize(size, Image.Resampling.LANCZOS)


def in_columns(panels: Sequence[Panel], columns: int) -> Iterator[Sequence[Panel]]:
    """Yield rows of so many panels; the last may have fewer."""
    return (panels[start : start + columns] for start in range(0, len(panels), columns))


def sheet(rows: Sequence[Sequence[Panel]], size: Size, font_size: int = 18) -> Image.Image:
    """Put rows of panels, all of one size, on white; a row without captions has no room for them.

    Parameters
    ----------
    rows
        From the top, each from the left.
    size
        Of the panels' pictures.
    font_size
        Of the captions, in pixels; a line is half as high again.
    """
    line, font = font_size * 3 // 2, ImageFont.load_default(font_size)
    lines = [line if any(caption for caption, _ in row) else 0 for row in rows]
    whole = Image.new("RGB", (size[0] * max(map(len, rows)), size[1] * len(rows) + sum(lines)), "white")
    draw, top = ImageDraw.Draw(whole), 0
    for row, above in zip(rows, lines, strict=True):
        for place, (caption, picture) in enumerate(row):
            left = place * size[0]
            draw.text((left + size[0] / 2, top + above / 2), caption, fill=INK, font=font, anchor="mm")
            if picture is not None:
                whole.paste(picture, (left, top + above))
        top += above + size[1]
    return whole


def save_jpeg(picture: Image.Image, path: Path, largest: int) -> None:
    """Write a JPEG of the best quality that takes at most `largest` bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    for quality in QUALITIES:
        picture.save(path, quality=quality, optimize=True)
        if path.stat().st_size <= largest:
            break


def save_png(picture: Image.Image, path: Path, colors: int = 64) -> None:
    """Write a PNG of few colours, without dots that stand for others."""
    path.parent.mkdir(parents=True, exist_ok=True)
    picture.quantize(colors, dither=Image.Dither.NONE).save(path, optimize=True)
