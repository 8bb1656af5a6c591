# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results: all of a model from the same side, with their edges, and coloured by their error."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.evaluation.normalization import LONGEST_SIDE
from hdpea.picture import Camera, draw_mesh
from hdpea.reading.triangle_mesh import TriangleMesh

SIZE = (560, 560)
"""Pixels of a picture."""

RED_FROM = LONGEST_SIDE.f1_threshold
"""Distance to the truth, in longest sides, from which the error map is red: where F1 counts a point as lost."""

COLORED_EDGE = 0.004
"""Longest edge, in longest sides, between two vertices of the error map: error within a triangle shows, too."""

MOST_FACES = 400_000
"""Of the error map, however large the result is."""

ERROR_COLORS = np.array([[244, 244, 240], [253, 218, 120], [240, 120, 50], [165, 15, 21]])
"""Of errors from 0 to ``RED_FROM``, evenly spaced."""


@dataclass(frozen=True)
class Scene:
    """The true surface and the camera that looks at it."""

    truth: TriangleMesh
    camera: Camera

    @classmethod
    def of(cls, truth: TriangleMesh) -> Scene:
        """Look at a surface."""
        return cls(truth, Camera.before(*truth))

    def draw_truth(self, path: Path) -> None:
        """Draw the truth with its edges."""
        draw_mesh(path, *self.truth, size=SIZE, camera=self.camera)

    def draw(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw a result with its edges."""
        draw_mesh(path, *mesh, size=SIZE, camera=self.camera)

    def draw_error(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw a result coloured by its distance to the truth."""
        longest = float(np.ptp(self.truth[0], axis=0).max())
        vertices, faces = subdivided(*mesh, COLORED_EDGE * longest)
        distances = _core.closest_surface_points(*self.truth, vertices).distance / longest
        draw_mesh(path, vertices, faces, size=SIZE, camera=self.camera, colors=error_colors(distances))


def error_colors(distances: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return distances (n,), in longest sides, as colours (n, 3)."""
    places = np.linspace(0, RED_FROM, len(ERROR_COLORS))
    channels = [np.interp(distances, places, channel) for channel in ERROR_COLORS.T]
    colors: NDArray[np.uint8] = np.rint(np.stack(channels, axis=1)).astype(np.uint8)
    return colors


def subdivided(vertices: NDArray[np.float64], faces: NDArray[np.int64], longest_edge: float) -> TriangleMesh:
    """Cut each triangle into n^2 alike ones, n such that edges get no longer than that, but for ``MOST_FACES``.

    Triangles share no vertices.
    """
    corners = vertices[faces]
    edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1)
    fewest = max(int((MOST_FACES / len(faces)) ** 0.5), 1)
    parts = np.clip(np.ceil(edges / longest_edge).astype(np.int64), 1, fewest)
    pieces, count = [], 0
    cells = []
    for n in np.unique(parts):
        weights, pattern = _grid(int(n))
        placed = np.einsum("kw,fwc->fkc", weights, corners[parts == n])
        starts = count + len(weights) * np.arange(len(placed))
        cells.append((pattern[None] + starts[:, None, None]).reshape(-1, 3))
        pieces.append(placed.reshape(-1, 3))
        count += len(pieces[-1])
    return np.vstack(pieces), np.vstack(cells)


def _grid(n: int) -> TriangleMesh:
    """Return barycentric weights (k, 3) of the points of a triangle cut into n^2, and the triangles (n^2, 3)."""
    number = {(i, j): k for k, (i, j) in enumerate((i, j) for i in range(n + 1) for j in range(n + 1 - i))}
    weights = np.array([[n - i - j, i, j] for i, j in number]) / n
    upward = [[number[i, j], number[i + 1, j], number[i, j + 1]] for i, j in number if i + j < n]
    downward = [[number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]] for i, j in number if i + j < n - 1]
    return weights, np.array(upward + downward, np.int64)
