# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds that were seen from one place, or are a height field: nothing in them lies behind anything else."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.surface.roughness import Roughness

Vectors = NDArray[np.float64]

SAMPLES = 5_000
"""Points that are looked at: a share of 5 % is certain to 0.3 %."""

GRAZING = 0.3
"""Least cosine between normal and line of sight at which it can be told which side was seen."""

LEAST_FACED = 0.5
"""Least share of the points that must be seen less grazingly than that."""

MOST_HIDDEN = 0.05
"""Largest share of the points that lie before or behind others where a cloud was seen from one place.

Of simulated scans of training meshes from one place, 0.1 to 10 % lie beside a silhouette, mostly 1 to 4 %; of closed
ones 11 to 90 % lie on the far side, seen from anywhere; of scans from three places 23 % and more; of the real ones in
docs/orientation.md 8 % and more."""

APART, DEVIATIONS_APART = 0.3, 3.0
"""How far from each other's planes two points are of different layers, in spacings, and in deviations of the noise."""

SPACING_NEIGHBORS = 16
"""Nearest points that the spacing around a point is measured by."""

LEAST_UPWARD = 0.6
"""Least mean cosine between a height field's normals and the vertical; of half a sphere, which has an inside, 0.5."""

WIDEST = 0.5
"""Least cosine between a line of sight and the middle one: cameras see a cone of 60 degrees at most.

A scanner amid its points sees more, but so does the middle of any closed thing."""

MIDDLE = 0.8
"""Share of the extent in x and y, about the middle, in which the origin is taken for a camera's below a height field."""


@dataclass(frozen=True)
class View:
    """From where a cloud was seen.

    Attributes
    ----------
    towards
        (n, 3) float64: from each point towards what saw it, of length 1.
    why
        How that is known, in words.
    from_one_place
        Whether a single sensor saw all of it, so that what that cannot see is missing.
    """

    towards: Vectors
    why: str
    from_one_place: bool

    @classmethod
    def of_sensors(cls, points: Vectors, sensors: Vectors) -> View:
        """Return that of points (n, 3) from the sensors (n, 3) that the file names, one for each."""
        return cls(towards_of(points, sensors), "the file says where the sensors were", bool(np.ptp(sensors, axis=0).max() == 0))


def towards_of(points: Vectors, seen_from: Vectors) -> Vectors:
    """Return the directions (n, 3) of length 1 from points (n, 3) to what saw them; 0 where it is in the point."""
    lines = seen_from - points
    # Squares of very long and very short lines are no doubles.
    lengths = abs(lines).max(axis=1, keepdims=True)
    lines /= np.where(lengths > 0, lengths, 1)
    return lines / np.maximum(np.linalg.norm(lines, axis=1, keepdims=True), 1)


def single_view(points: Vectors, directions: Vectors, roughness: Roughness, origin: Vectors) -> View | None:
    """Return from where points (n, 3) were seen if nothing hides anything else from there; else None.

    That place is the `origin` (3,) of the file, where a camera has its own, if all points lie within a cone seen from
    there; or far above. The signs of the `directions` (n, 3) of the normals do not matter.
    """
    low, high = points.min(axis=0)[:2], points.max(axis=0)[:2]
    from_middle = abs(origin[:2] - (low + high) / 2) < MIDDLE * (high - low) / 2
    # Terrain may be seen in full from its local origin, too; but hardly with that in its middle.
    found = (_from_origin, _from_above) if from_middle.all() else (_from_above, _from_origin)
    return next(filter(None, (find(points, directions, roughness, origin) for find in found)), None)


def _from_origin(points: Vectors, directions: Vectors, roughness: Roughness, origin: Vectors) -> View | None:
    towards = towards_of(points, origin)
    middle = towards.mean(axis=0)
    if (towards @ middle).min() <= WIDEST * np.linalg.norm(middle):
        return None
    if _hides_itself(points, directions, roughness, towards, towards):
        return None
    return View(towards, "seen from one place, the origin: no point lies behind another", True)


def _from_above(points: Vectors, directions: Vectors, roughness: Roughness, _origin: Vectors) -> View | None:
    if abs(directions[:, 2]).mean() < LEAST_UPWARD:
        return None
    up = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    if _hides_itself(points, directions, roughness, up, points * [1.0, 1.0, 0.0]):
        return None
    return View(up, "a height field, seen from above: no point lies below another", False)


def _hides_itself(
    points: Vectors, directions: Vectors, roughness: Roughness, towards: Vectors, places: Vectors
) -> bool:
    """Return whether points that are neighbours in the picture, by their `places` (n, 3) there, differ in depth."""
    facing = abs(np.einsum("nc,nc->n", directions, towards)) > GRAZING
    if facing.mean() < LEAST_FACED:
        return True
    rows = np.linspace(0, len(points) - 1, min(SAMPLES, len(points))).astype(np.int64)
    nearest = _core.nearest_neighbors(places, np.ascontiguousarray(places[rows]), 2)
    others = np.where(nearest[:, 0] == rows, nearest[:, 1], nearest[:, 0])
    clear = facing[rows] & facing[others]
    rows, others = rows[clear], others[clear]
    offsets = points[others] - points[rows]
    heights = np.stack([np.einsum("nc,nc->n", offsets, directions[ends]) for ends in (rows, others)])
    layered = abs(heights).min(axis=0) > _apart(points, rows, roughness)
    return bool(layered.mean() > MOST_HIDDEN)


def _apart(points: Vectors, rows: NDArray[np.int64], roughness: Roughness) -> Vectors:
    """Return how far from the plane of each of the points `rows` (m,) another layer is at least."""
    count = min(SPACING_NEIGHBORS, len(points) - 1)
    around = points[_core.nearest_neighbors(points, np.ascontiguousarray(points[rows]), count + 1)]
    radii = np.linalg.norm(around[:, -1] - points[rows], axis=1)
    spacings = radii * np.sqrt(np.pi / count)
    return np.asarray(max(APART, DEVIATIONS_APART * roughness.noise) * spacings)
