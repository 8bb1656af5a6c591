# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds on which options show what they do: two of libcgal-demo, whole, with a hole, with noise, and so on; a knot."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
from demo_data import CLOUDS, demo_files
from numpy.typing import NDArray
from plyfile import PlyData, PlyElement

from hdpea import read_points

HOLE, RADIUS = (0.0, 0.1, 0.29), 0.12
"""Where the kitten, which is 1 high, has no points."""

NOISE = 0.012
"""Standard deviation along each axis: 0.7 spacings of the kitten's points."""

STRIPE = 0.05
GROUND = -0.0625
"""Height below which points of the house are taken for ground."""


def option_clouds(folder: Path) -> None:
    """Write the clouds to `folder`, each as NAME.ply, and the two of libcgal-demo under their names."""
    files = demo_files(folder, CLOUDS, ["kitten.xyz", "point_set_3.xyz"])
    kitten, house = (read_points(file).points for file in files)
    random = np.random.default_rng(0)
    sphere = random.standard_normal((20_000, 3))
    sphere /= np.linalg.norm(sphere, axis=1, keepdims=True)
    made = {
        "hole": kitten[np.linalg.norm(kitten - HOLE, axis=1) > RADIUS],
        "noisy": kitten + NOISE * random.standard_normal(kitten.shape),
        "head": kitten[kitten[:, 1] > 0],
        "body": kitten[kitten[:, 1] < 0.05],
    }
    for name, points in made.items():
        _write(folder / f"{name}.ply", points)
    _write(folder / "inward.ply", sphere[:5_000], nx=-sphere[:5_000, 0], ny=-sphere[:5_000, 1], nz=-sphere[:5_000, 2])
    _write(folder / "classes.ply", house, classification=np.where(house[:, 2] < GROUND, 2, 6).astype(np.uint8))
    striped = np.floor(kitten[:, 1] / STRIPE) % 2 == 0
    light, dark = (np.array(each, np.uint8) for each in ((240, 240, 220), (240, 90, 20)))
    colors = np.where(striped[:, None], light, dark)
    _write(folder / "striped.ply", kitten, **dict(zip(("red", "green", "blue"), colors.T, strict=True)))
    shapes = Path(__file__).parents[1] / "examples/shapes.py"
    subprocess.run([sys.executable, shapes, "knot", folder / "knot.ply", "--points", "12000"], check=True)


def _write(path: Path, points: NDArray[np.float64], **columns: NDArray[np.generic]) -> None:
    """Write points (n, 3), and columns (n,), as a binary PLY."""
    table = {**dict(zip("xyz", points.T, strict=True)), **columns}
    rows = np.rec.fromarrays([*table.values()], names=[*table])
    PlyData([PlyElement.describe(rows, "vertex")]).write(path)
