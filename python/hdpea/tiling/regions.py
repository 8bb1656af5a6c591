# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of a mesh that can be edited alone, between vertices that stay where they are."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hdpea import _core


class Region(NamedTuple):
    """A part of a mesh that is a manifold mesh itself.

    Attributes
    ----------
    rows
        (g,) int64: which faces of the mesh it takes.
    vertices
        (w,) int64: which vertices, those first that faces outside have, too.
    faces
        (g, 3) int64: the faces by the rows of `vertices`.
    fixed
        How many vertices the region shares with faces outside.
    """

    rows: NDArray[np.int64]
    vertices: NDArray[np.int64]
    faces: NDArray[np.int64]
    fixed: int

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Which of its vertices (w,) are fixed."""
        return np.arange(len(self.vertices)) < self.fixed


def region_of(faces: NDArray[np.int64], wanted: NDArray[np.bool_], unknown: NDArray[np.bool_]) -> Region:
    """Return the `wanted` faces (f,) of a manifold mesh with as few others as make them a region.

    Others are those around a vertex at which the wanted ones would meet in more than one fan, and those at an edge
    outside between two fixed vertices, which an edit inside could join a second time.

    Parameters
    ----------
    faces
        (f, 3) int64: the mesh, or a part of it that reaches well beyond what is wanted.
    unknown
        (v,) bool: vertices at which there may be faces that are not among these; they are fixed.
    """
    chosen = wanted.copy()
    count = int(faces.max(initial=-1)) + 1
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]], axis=2)  # (f, 3, 2)
    keys = edges[:, :, 0] * count + edges[:, :, 1]  # (f, 3)
    while True:
        inside, outside = faces[chosen], faces[~chosen]
        shared = unknown[:count].copy()
        shared[outside] = True
        used = np.zeros(count, dtype=bool)
        used[inside] = True
        fixed = shared & used
        inner, times = np.unique(keys[chosen], return_counts=True)
        border = inner[times == 1]
        fans = np.bincount(np.concatenate([border // max(count, 1), border % max(count, 1)]), minlength=count)
        around = (fans > 2)[faces].any(axis=1)
        chord = (fixed[edges].all(axis=2) & ~np.isin(keys, inner)).any(axis=1)
        more = ~chosen & (around | chord)
        if not more.any():
            break
        chosen |= more
    rows = np.flatnonzero(chosen)
    vertices = np.concatenate([np.flatnonzero(fixed), np.flatnonzero(used & ~fixed)])
    number = np.zeros(count, dtype=np.int64)
    number[vertices] = np.arange(len(vertices))
    return Region(rows, vertices, number[faces[rows]], int(fixed.sum()))


def points_at(
    region: Region, vertices: NDArray[np.float64], faces: NDArray[np.int64], points: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Return which points (n, 3) are nearest to a face at a vertex of the region, among all `faces` that are known.

    Those of what passes by beyond the rim would pull at the region from afar.
    """
    of_region = np.zeros(len(vertices), dtype=bool)
    of_region[region.vertices] = True
    nearest = faces[_core.closest_surface_points(vertices, faces, points).face]
    return np.asarray(of_region[nearest].any(axis=1))
