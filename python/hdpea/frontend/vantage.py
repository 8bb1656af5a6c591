# SPDX-License-Identifier: GPL-3.0-or-later
"""Scans in the frame of their scanner: whether it stood in the origin, told by how the points are spread."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.directions import fibonacci_spiral
from hdpea.geometry.thinning import rows_along
from hdpea.reading.cloud import PointCloud

SAMPLES = 2_000
"""Points at which it is looked how far apart they are."""

NEAREST = 24
"""Nearest points that this is measured by: those of more than one scan line."""

LEAST_UNEVEN, MOST_UNEVEN_AS_SEEN = 0.6, 1 / 3
"""Least unevenness along the surface, and the largest share of it that is left as seen from the origin.

Unevenness is the logarithm of how many times farther apart a tenth of the points is than another tenth. That of the
frames of ten rotating lidars and depth cameras is 0.7 to 2.8, of which 1 to 18 % is left; of 25 models about their
origins and 24 of the clouds of Debian's libcgal-demo 90 % and more."""

LEAST_BLIND, DIRECTIONS = 20.0, 500
"""Least angle in degrees between some direction and that of any point, and how many directions are tried.

What surrounds its origin on all sides may be a thing as well as a room."""

LIKELY_UNEVEN_AS_SEEN = 0.65
"""Largest such share at which a note asks whether a scanner stood there: of two rooms it is 46 and 53 %."""

TAKEN = "The points are as even as a scanner in the origin sees them: it is taken for the place of the sensor."
LIKELY = "If a scanner in the origin saw these points, say so: `orient` viewpoint, `viewpoint` 0,0,0."


def with_sensor_found(cloud: PointCloud) -> PointCloud:
    """Return a cloud that names no sensors with one in the origin, and a note, if it was scanned from there.

    A scanner's rays are as far apart at all distances, but its points are not: the same surface is sampled four times
    as densely at half the distance. Signs of normals need it, as nothing is enclosed by what surrounds a scanner.
    """
    if cloud.sensors() is not None:
        return cloud
    # Some scanners write a ray without a return as a point in themselves.
    points = cloud.points[cloud.points.any(axis=1)]
    if (share := _uneven_as_seen(points)) is None:
        return cloud
    if share > MOST_UNEVEN_AS_SEEN or _blind_angle(points) < LEAST_BLIND:
        return cloud if cloud.normals is not None else replace(cloud, notes=(*cloud.notes, LIKELY))
    sensors = {"sensor": np.zeros_like(cloud.points)}
    return replace(cloud, attributes={**cloud.attributes, **sensors}, notes=(*cloud.notes, TAKEN))


def _uneven_as_seen(points: NDArray[np.float64]) -> float | None:
    """Return which share of their unevenness distinct points (n, 3) have as seen from the origin, if it is likely.

    None of them may lie there.
    """
    # What is too small or too large for squares is no scan in metres.
    with np.errstate(over="ignore", under="ignore"):
        distances = np.linalg.norm(points, axis=1)
    if len(points) <= NEAREST or not np.isfinite(distances).all() or not distances.all():
        return None
    along = unevenness(points)
    if along < LEAST_UNEVEN:
        return None
    share = unevenness(points / distances[:, None]) / along
    return share if share < LIKELY_UNEVEN_AS_SEEN else None


def unevenness(points: NDArray[np.float64], nearest: int = NEAREST, left_out: float = 0.1) -> float:
    """Return the logarithm of how many times the largest distance of points (n, 3) to a nearest other is the least.

    It is that to the last of so many nearest ones, and a share at either end is left out. Infinite if points coincide.
    """
    places = np.ascontiguousarray(points[rows_along(len(points), SAMPLES)])
    with core_errors_translated():
        last = _core.nearest_neighbors(np.ascontiguousarray(points), places, nearest + 1)[:, -1]
    low, high = np.quantile(np.linalg.norm(points[last] - places, axis=1), [left_out, 1 - left_out])
    return float(np.log(high / low)) if low > 0 else np.inf


def _blind_angle(points: NDArray[np.float64]) -> float:
    """Return the largest angle in degrees between a direction and that from the origin to any of points (n, 3)."""
    seen = np.ascontiguousarray(points / np.linalg.norm(points, axis=1, keepdims=True))
    directions = fibonacci_spiral(DIRECTIONS)
    nearest = _core.nearest_neighbors(seen, directions, 1)[:, 0]
    cosines = np.einsum("nc,nc->n", directions, seen[nearest])
    return float(np.degrees(np.arccos(cosines.min().clip(-1, 1))))
