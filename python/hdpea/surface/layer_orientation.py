# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side is out where misplaced scans of one closed thing may pass for the two sides of a thin wall."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.thinning import farthest_rows, rows_along
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.layers import have_layers, layered_samples
from hdpea.surface.orientation import DECIDING, Orientation, SignEvidence, Vectors, followed, turned

WIDER = 2.4
"""By how many spacings the winding number is smoothed more: across layers up to three spacings apart."""

SHELL, QUERIES = 4_000, 300
"""Points that the winding number is summed over, and places beside them where it is looked at."""

BESIDE = 3.0
"""How far beside the surface, in spacings of the points that are summed over: beyond the layers."""

OUTSIDE, INSIDE = 0.25, 0.6
"""Largest winding number, in magnitude, outside of a closed thing, and the least within: without errors 0, and 1 to 2.

Beside the wall of an open vessel, whose two sides were oriented as one sheet, it is 0 on both sides, or on neither."""

MOSTLY = 0.8
"""Share of the points in layers on whose sides it has to be so."""


def orient_layers(
    points: Vectors, neighbors: NDArray[np.int64], evidence: SignEvidence, progress: PhaseCallback | None = None
) -> Orientation | None:
    """Orient points (n, 3) as layers that face the same way, if there are any and these enclose something; else None.

    Planes are fitted to all `neighbors` (n, 40), of both layers, the winding number is smoothed across them. Of a thin
    wall it then knows nothing: only if the signs that it gives make layers of what they enclose, it is none.
    """
    directions = _core.estimate_normals(points, neighbors)
    if not have_layers(points, directions, signed=False):
        return None
    deciding = np.sort(farthest_rows(points, DECIDING)) if len(points) > DECIDING else np.arange(len(points))
    few, planes = (np.ascontiguousarray(each[deciding]) for each in (points, directions))
    options = _core.WnncOptions()
    options.spacings_wide += WIDER
    signed = turned(planes, _core.wnnc_normals(few, options, progress))
    nearest = _core.nearest_neighbors(few, evidence.neighbors.shape[1])
    signed = _core.agree_on_signs(few, signed, nearest)
    normals = signed if len(few) == len(points) else followed(points, directions, few, signed)
    if not have_layers(points, normals) or not _encloses(points, normals):
        return None
    return Orientation(normals, "wnnc", "layers a few spacings apart face the same way, and enclose what they show")


def _encloses(points: Vectors, normals: Vectors) -> bool:
    """Tell whether the layers of oriented points (n, 3) enclose something: nothing on one side, all on the other."""
    layered = layered_samples(points, normals)
    rows = farthest_rows(points, min(SHELL, len(points)))
    shell, facing = points[rows], normals[rows]
    apart = _core.nearest_neighbors(np.ascontiguousarray(shell), 10)[:, -1]
    areas = np.pi * np.square(shell[apart] - shell).sum(axis=1) / 10
    asked = layered[rows_along(len(layered), QUERIES)]
    beside = BESIDE * np.sqrt(np.median(areas)) * normals[asked]
    outside, inside = (
        _winding_numbers(shell, areas[:, None] * facing, points[asked] + way * beside) for way in (1, -1)
    )
    return bool(((abs(outside) < OUTSIDE) & (inside > INSIDE)).mean() > MOSTLY)


def _winding_numbers(shell: Vectors, areas: Vectors, queries: Vectors) -> NDArray[np.float64]:
    """Return how often points (m, 3) with area vectors (m, 3) enclose each of the queries (q, 3): solid angles."""
    offsets = shell - queries[:, None]
    solid_angles = np.einsum("qmc,mc->qm", offsets, areas) / np.linalg.norm(offsets, axis=2) ** 3
    return np.asarray(solid_angles.sum(axis=1) / (4 * np.pi))
