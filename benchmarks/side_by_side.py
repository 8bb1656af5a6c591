# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of one thing in one picture."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from hdpea.picture import Camera, draw_mesh

PANEL = (320, 320)
"""Width and height of each, in pixels."""

COLORS = 64
"""Different ones in the picture: it is to be small."""


def draw_side_by_side(path: Path, meshes: Sequence[tuple[NDArray[np.float64], NDArray[np.int64]]]) -> None:
    """Draw meshes (vertices, faces) from left to right, all seen as the first one is."""
    camera = Camera.before(*meshes[0])
    row = Image.new("RGB", (PANEL[0] * len(meshes), PANEL[1]))
    with TemporaryDirectory() as folder:
        for place, mesh in enumerate(meshes):
            panel = Path(folder) / f"{place}.png"
            draw_mesh(panel, *mesh, size=PANEL, camera=camera)
            with Image.open(panel) as drawn:
                row.paste(drawn, (place * PANEL[0], 0))
    path.parent.mkdir(parents=True, exist_ok=True)
    row.quantize(COLORS).save(path, optimize=True)
