# SPDX-License-Identifier: GPL-3.0-or-later
"""Layers of misplaced scans: a few spacings apart as the sides of a thin wall are, but they face the same way."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.directions import directions_of
from hdpea.geometry.thinning import rows_along
from hdpea.runtime.blocks import in_blocks

SAMPLES = 2_000
"""Points at which it is looked whether there are any."""

AROUND = 24
"""Nearest points that are looked at around each."""

ALIKE = 0.5
"""Least cosine of the normals around a point in a layer: at creases and rims layers cannot be told from steps."""

STEEP, LEAST_HEIGHT = 0.7, 0.5
"""Slope, as a sine, and height in spacings from which a point lies above another rather than beside it."""

MOST_HEIGHT = 2.5
"""Height in spacings up to which two layers are one surface seen twice: sheets that lie farther apart are two."""

AROUND_DOUBLED, MOST_HEIGHT_DOUBLED = 64, 4.0
"""The same where strips are known to overlap: of 24 nearest points, none lies on a layer three spacings off."""

CHUNK = 50_000
"""Points that are looked at at once, which bounds the memory."""

WIDENED = 2
"""How often the points in layers take in those around them: the fit passes from one layer to two."""

LEAST_SHARE = 0.02
"""Least share of points in layers that is not chance.

Of 42 training meshes with true normals (5,000 and 40,000 points) 0.15 % lie in layers at most; of two scans of a ball
1 to 3 spacings out of register 48 to 74 %, of two halves that overlap by a tenth 17 to 22 %."""


def are_layered(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    rows: NDArray[np.int64],
    around: NDArray[np.int64],
    most_height: float,
) -> NDArray[np.bool_]:
    """Return which `rows` (m,) of points (n, 3) have another above or below that faces the same way, (m,) bool.

    Between two layers of a solid that face the same way one faces the other way; where there is none near,
    they are one surface that was seen twice.

    Parameters
    ----------
    normals
        (n, 3) unit, of consistent signs: the sides of thin walls are no layers.
    around
        (m, k) the nearest points of each, whatever sheet they lie on.
    most_height
        Heights above it are no layers', as ``MOST_HEIGHT`` times the spacing of most points.
    """
    offsets = points[around] - points[rows, None]
    own = normals[rows, None]
    cosines = (normals[around] * own).sum(axis=2)
    heights = np.minimum(abs((offsets * own).sum(axis=2)), abs((offsets * normals[around]).sum(axis=2)))
    lengths = np.linalg.norm(offsets, axis=2)
    # A disk that reaches to the k-th neighbour holds k points.
    spacing = lengths[:, -1] * np.sqrt(np.pi / around.shape[1])
    above = (heights > STEEP * lengths) & (heights > LEAST_HEIGHT * spacing[:, None]) & (heights < most_height)
    return np.asarray(above.any(axis=1) & (cosines > ALIKE).all(axis=1))


def have_layers(points: NDArray[np.float64], normals: NDArray[np.float64]) -> bool:
    """Tell whether more of points (n, 3) lie in layers, as ``are_layered`` has it, than do by chance."""
    return len(layered_samples(points, normals)) > LEAST_SHARE * min(len(points), SAMPLES)


def layered_samples(points: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the rows (m,) of those of 2,000 of the points (n, 3) that lie in layers."""
    if len(points) <= AROUND:
        return np.empty(0, dtype=np.int64)
    rows = rows_along(len(points), SAMPLES)
    around = _core.nearest_neighbors(points, np.ascontiguousarray(points[rows]), AROUND + 1)[:, 1:]
    return rows[are_layered(points, normals, rows, around, _most_height(points, rows, around, MOST_HEIGHT))]


def layered_region(points: NDArray[np.float64], normals: NDArray[np.float64], *, doubled: bool) -> NDArray[np.int64]:
    """Return the rows (m,) of the points (n, 3) in layers and of those around them.

    Where strips are known to overlap, these may lie farther apart.
    """
    around = _core.nearest_neighbors(points, min(AROUND_DOUBLED if doubled else AROUND, len(points) - 1))
    sampled = rows_along(len(points), SAMPLES)
    highest = MOST_HEIGHT_DOUBLED if doubled else MOST_HEIGHT
    most_height = _most_height(points, sampled, around[sampled], highest)
    inside = np.zeros(len(points), dtype=bool)
    for rows in np.array_split(np.arange(len(points)), len(points) // CHUNK + 1):
        inside[rows] = are_layered(points, normals, rows, around[rows], most_height)
    for _ in range(WIDENED):
        inside[around[inside].ravel()] = True
    return np.flatnonzero(inside)


def mean_normals(points: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean (n, 3) of the unit normals around each of points (n, 3), of length 1.

    Where normals were fitted to two layers at once they lie any way, but on average across both.
    """
    around = _core.nearest_neighbors(points, min(AROUND_DOUBLED, len(points) - 1))
    sums = in_blocks(lambda rows: normals[around[rows]].sum(axis=1), len(points)) + normals
    return directions_of(sums, otherwise=normals)


def _most_height(
    points: NDArray[np.float64], rows: NDArray[np.int64], around: NDArray[np.int64], spacings: float
) -> float:
    """Return so many spacings in the unit of the points; at rims alone the nearest points reach too far to tell it."""
    reaches = np.linalg.norm(points[around[:, -1]] - points[rows], axis=1)
    return spacings * float(np.median(reaches)) * float(np.sqrt(np.pi / around.shape[1]))
