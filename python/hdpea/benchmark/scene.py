# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the results for a model, from one viewpoint: with edges, and coloured by error."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.evaluation.normalization import LONGEST_SIDE
from hdpea.geometry.thinning import thinned
from hdpea.geometry.triangles import TriangleMesh
from hdpea.pictures.colors import as_bytes
from hdpea.pictures.picture import Camera, draw_mesh, draw_points
from hdpea.surface.normals import oriented_surface

SIZE = (560, 560)
"""Pixels of a picture."""

RED_FROM = LONGEST_SIDE.f1_threshold
"""Distance to the truth, in longest sides, from which the error map is red: the threshold of F1."""

COLORED_EDGE = 0.004
"""Longest edge of the error map, in longest sides, so that it shows errors inside triangles, too."""

MOST_FACES = 400_000
"""Most faces of the error map."""

ERROR_COLORS = np.array([[244, 244, 240], [253, 218, 120], [240, 120, 50], [165, 15, 21]])
"""Colours of errors from 0 to ``RED_FROM``, evenly spaced."""


SHOWN_POINTS = 40_000
"""Points drawn of a truth that is a point cloud: enough to leave no gaps."""

LIGHT = np.array([-0.28, 0.41, 0.87])
"""Direction towards the light in view coordinates: above on the left, as for meshes; unit."""


@dataclass(frozen=True)
class Scene(ABC):
    """The truth and the camera from which it and all results are drawn."""

    camera: Camera

    @abstractmethod
    def draw_truth(self, path: Path) -> None:
        """Draw the truth."""

    @abstractmethod
    def draw_error(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw the error of a result."""

    def draw(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw a result with its edges."""
        draw_mesh(path, *mesh, size=SIZE, camera=self.camera)


@dataclass(frozen=True)
class SurfaceScene(Scene):
    """A scene whose truth is a surface."""

    truth: TriangleMesh

    @classmethod
    def of(cls, truth: TriangleMesh) -> SurfaceScene:
        """Place the camera for a surface."""
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
    """A scene whose truth is points (n, 3); `shown` (m, 3), with their `normals` (m, 3), are drawn."""

    points: NDArray[np.float64]
    shown: NDArray[np.float64]
    normals: NDArray[np.float64]

    @classmethod
    def of(cls, points: NDArray[np.float64], normals: NDArray[np.float64] | None) -> PointScene:
        """Place the camera for points (n, 3), finite and distinct, with unit normals (n, 3), 0 where unknown.

        Raises
        ------
        CannotReconstruct
            If they are too few, equal or on a line.
        """
        rows = thinned(len(points), SHOWN_POINTS)
        oriented = oriented_surface(points[rows], None if normals is None else normals[rows]).surface.normals
        return cls(Camera.before_points(points[rows], oriented), points, points[rows], oriented)

    def draw_truth(self, path: Path) -> None:
        """Draw the truth as points, shaded like a mesh."""
        draw_points(path, self.shown, shades(self.normals @ self.camera.view_from_world.T), SIZE, self.camera)

    def draw_error(self, path: Path, mesh: TriangleMesh) -> None:
        """Draw the points of the truth coloured by their distance to a result."""
        longest = float(np.ptp(self.points, axis=0).max())
        distances = _core.closest_surface_points(*mesh, self.points).distance / longest
        draw_points(path, self.points, error_colors(distances), SIZE, self.camera)


def shades(normals_in_view: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return greys (n, 3) for normals (n, 3) of either sign in view coordinates: x right, y up, z towards the eye."""
    return as_bytes(np.tile(0.3 + 0.6 * abs(normals_in_view @ LIGHT)[:, None], 3))


def error_colors(distances: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return the colours (n, 3) of distances (n,), in longest sides."""
    places = np.linspace(0, RED_FROM, len(ERROR_COLORS))
    channels = [np.interp(distances, places, channel) for channel in ERROR_COLORS.T]
    colors: NDArray[np.uint8] = np.rint(np.stack(channels, axis=1)).astype(np.uint8)
    return colors


def subdivided(vertices: NDArray[np.float64], faces: NDArray[np.int64], longest_edge: float) -> TriangleMesh:
    """Cut each triangle into n^2 similar ones, with n such that no edge is longer, within ``MOST_FACES``.

    The given triangles share no vertices in the result.
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
