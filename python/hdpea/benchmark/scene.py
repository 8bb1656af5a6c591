# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results: all of a model from the same side, with their edges, and coloured by their error."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.evaluation.normalization import LONGEST_SIDE
from hdpea.geometry.thinning import thinned
from hdpea.pictures.colors import as_bytes
from hdpea.pictures.picture import Camera, draw_mesh, draw_points
from hdpea.reading.triangle_mesh import TriangleMesh
from hdpea.surface.normals import oriented_surface

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


SHOWN_POINTS = 40_000
"""Of a truth that is points, in its picture: enough to leave no gaps."""

LIGHT = np.array([-0.28, 0.41, 0.87])
"""Where the light comes from as the eye sees it: above, on the left, as on meshes; unit."""


@dataclass(frozen=True)
class Scene(ABC):
    """The truth, and the camera that looks at it."""

    camera: Camera

    @abstractmethod
    def draw_truth(self, path: Path) -> None:
        """Draw the truth."""

    @abstractmethod
    def draw_error(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw how far a result is from the truth."""

    def draw(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw a result with its edges."""
        draw_mesh(path, *mesh, size=SIZE, camera=self.camera)


@dataclass(frozen=True)
class SurfaceScene(Scene):
    """A true surface, to be looked at."""

    truth: TriangleMesh

    @classmethod
    def of(cls, truth: TriangleMesh) -> SurfaceScene:
        """Look at a surface."""
        return cls(Camera.before(*truth), truth)

    def draw_truth(self, path: Path) -> None:
        """Draw the truth with its edges."""
        draw_mesh(path, *self.truth, size=SIZE, camera=self.camera)

    def draw_error(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw a result coloured by its distance to the truth."""
        longest = float(np.ptp(self.truth[0], axis=0).max())
        vertices, faces = subdivided(*mesh, COLORED_EDGE * longest)
        distances = _core.closest_surface_points(*self.truth, vertices).distance / longest
        draw_mesh(path, vertices, faces, size=SIZE, camera=self.camera, colors=error_colors(distances))


@dataclass(frozen=True)
class PointScene(Scene):
    """Points (n, 3) of a surface that is not known, to be looked at; `shown` (m, 3) and `normals` (m, 3) of some."""

    points: NDArray[np.float64]
    shown: NDArray[np.float64]
    normals: NDArray[np.float64]

    @classmethod
    def of(cls, points: NDArray[np.float64], normals: NDArray[np.float64] | None) -> PointScene:
        """Look at points (n, 3), finite and distinct, and their unit normals (n, 3), 0 where unknown.

        Raises
        ------
        CannotReconstruct
            If they are too few, equal or on a line.
        """
        rows = thinned(len(points), SHOWN_POINTS)
        oriented = oriented_surface(points[rows], None if normals is None else normals[rows]).surface.normals
        return cls(Camera.before_points(points[rows], oriented), points, points[rows], oriented)

    def draw_truth(self, path: Path) -> None:
        """Draw the truth as points, shaded as a mesh is."""
        draw_points(path, self.shown, shades(self.normals @ self.camera.view_from_world.T), SIZE, self.camera)

    def draw_error(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw the points of the truth coloured by their distance to a result."""
        longest = float(np.ptp(self.points, axis=0).max())
        distances = _core.closest_surface_points(*mesh, self.points).distance / longest
        draw_points(path, self.points, error_colors(distances), SIZE, self.camera)


def shades(normals_in_view: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return a grey (n, 3) for each normal (n, 3), x to the right, y up, z towards the eye, whichever side shows."""
    return as_bytes(np.tile(0.3 + 0.6 * abs(normals_in_view @ LIGHT)[:, None], 3))


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
