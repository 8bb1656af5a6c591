# SPDX-License-Identifier: GPL-3.0-or-later
"""Clouds that were seen from one place, or are a height field: nothing in them lies behind anything else."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.frontend.one_layer import are_of_one_layer
from hdpea.frontend.roughness import Roughness
from hdpea.geometry.thinning import rows_along
from hdpea.surface.sampling_pattern import hardly_seen_from

Vectors = NDArray[np.float64]

SAMPLES = 5_000
"""Points that are looked at: a share of 5 % is certain to 0.3 %."""

GRAZING = 0.3
"""Least cosine between normal and line of sight at which it can be told which side was seen."""

LEAST_FACED = 0.5
"""Least share of the points that must be seen less grazingly than that."""

MOST_HIDDEN = 0.05
"""Largest share of the points that lies before or behind others where a cloud was seen from one place.

On every fourth training mesh, 10,000 points: of scans from one place 0.1 to 10 % lie beside a silhouette, mostly 1 to
4 %, and 49 of 63 are recognised (56 with noise of 0.2 % of the diagonal); of closed clouds seen from outside, and of
scans from three places, 23 % and more lie behind others, and none passes for one view. The real clouds of
docs/orientation.md that were not seen from one place have 8 % and more."""

APART, DEVIATIONS_APART = 0.3, 4.0
"""Least distance of layers from each other, in spacings, and in standard deviations of the noise.

Of fewer deviations, noise alone looks like layers."""

DEVIATIONS_BELOW = 6.0
"""The same for points of which each is to be told: of a wall with noise of 0.4 spacings 2.5 % are below by four."""

DOUBLED, MOST_DOUBLED = 4.0, 0.25
"""Farthest that the layers of a height field's overlapping strips lie apart, in spacings, and the largest share of the
points that lies in layers at all.

Strips of terrain, of a flat sheet and of half a cylinder that overlap in a band, 0.3 to 3 spacings out of register,
have 9 to 18 % in layers, all of them so near. Of a third of the training meshes, from three directions, 44 % and more
are above others, of thin plates most of them so near."""

MOST_OVERHUNG, MOST_BELOW, LEAST_LEVEL = 0.2, 0.3, 0.8
"""Largest shares of land that lie above or below other points, far from these and at all, and how level it must be
instead (mean cosine between normals and the vertical): under trees and eaves a laser reaches the ground.

CGAL's b9_training, from an aeroplane, has 0.14, 0.25 and 0.93. Of 105 scans of 49 meshes from two to eight places those
that are as level have 0.75 and more in layers; of those with the fewest, 0.37, it is 0.4."""

MOST_NOISE = 0.5
"""Most noise of a height field, in spacings, where it is not asked whether the points are of one layer.

With more, the two sides of a thin plate pass for one layer: of 3 of 63 training meshes with noise of 0.3 % of the
diagonal, 0.7 spacings and more. They would pass in a camera's view, too, but closed shapes are rarely before one."""

BESIDE = 4
"""Points next to one, as seen from above, of which each may lie above it: of two layers alike one of them does."""

SPACING_NEIGHBORS = 16
"""Nearest points that the spacing around a point is measured by."""

LEAST_UPWARD = 0.6
"""Least mean cosine between a height field's normals and the vertical; of half a sphere, which has an inside, 0.5."""

WIDEST = 0.5
"""Least cosine between a line of sight and the middle one: cameras see a cone of 60 degrees at most.

A scanner amid its points sees more, but so does the middle of any closed thing."""

MIDDLE = 0.8
"""Share of the extent in x and y, about the middle, in which the origin is taken for a camera's."""


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
    doubled
        Whether strips overlap in it that do not meet: layers near each other that were both seen from there.
    from_above
        Whether it is a height field.
    overhung
        Whether it is one but for trees, eaves and the like above parts of it.
    below
        (n,) bool: which points of a height field lie below others all the same, if any do.
    """

    towards: Vectors
    why: str
    from_one_place: bool
    doubled: bool = False
    from_above: bool = False
    overhung: bool = False
    below: NDArray[np.bool_] | None = None

    @classmethod
    def of_sensors(cls, points: Vectors, sensors: Vectors) -> View:
        """Return that of points (n, 3) from their sensors (n, 3), one for each."""
        return cls(
            towards_of(points, sensors),
            "it is known where the sensors were",
            bool(np.ptp(sensors, axis=0).max() == 0),
        )


def towards_of(points: Vectors, seen_from: Vectors) -> Vectors:
    """Return the directions (n, 3) of length 1 from points (n, 3) to what saw them; 0 where it is in the point."""
    lines = seen_from - points
    # Squares of very long and very short lines are no doubles.
    lengths = abs(lines).max(axis=1, keepdims=True)
    lines /= np.where(lengths > 0, lengths, 1)
    return np.asarray(lines / np.maximum(np.linalg.norm(lines, axis=1, keepdims=True), 1))


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
    if sum(_layered(points, directions, roughness.noise, towards, towards)) > MOST_HIDDEN:
        return None
    if hardly_seen_from(points, origin):
        return None
    return View(towards, "seen from one place, the origin: no point lies behind another", True)


def _from_above(points: Vectors, directions: Vectors, roughness: Roughness, _origin: Vectors) -> View | None:
    if abs(directions[:, 2]).mean() < LEAST_UPWARD:
        return None
    if roughness.noise > MOST_NOISE and not are_of_one_layer(points):
        return None
    up = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    places = points * [1.0, 1.0, 0.0]
    near, far = _layered(points, directions, roughness.noise, up, places)
    if far <= MOST_HIDDEN and near + far <= MOST_DOUBLED:
        doubled = near > MOST_HIDDEN
        besides = ", but for layers of strips that overlap" if doubled else ""
        why = f"a height field, seen from above: no point lies below another{besides}"
        below = None if doubled else _below(points, directions, roughness.noise, places)
        return View(up, why, False, doubled, from_above=True, below=below)
    if far <= MOST_OVERHUNG and near + far <= MOST_BELOW and abs(directions[:, 2]).mean() >= LEAST_LEVEL:
        why = f"land, seen from above: {near + far:.0%} of the points lie above or below others"
        below = _below(points, directions, roughness.noise, places)
        return View(up, why, False, from_above=True, overhung=True, below=below)
    return None


def _layered(
    points: Vectors, directions: Vectors, noise: float, towards: Vectors, places: Vectors
) -> tuple[float, float]:
    """Return the shares of points that lie in layers, near each other and far, of those that are seen well.

    Those are neighbours in the picture that are apart by more than the `noise`. Their `places` (n, 3) in the picture
    are those of their lines of sight. Where hardly any are seen well, all count as hidden.
    """
    facing = abs(np.einsum("nc,nc->n", directions, towards)) > GRAZING
    if facing.mean() < LEAST_FACED:
        return 0.0, 1.0
    rows = rows_along(len(points), SAMPLES)
    nearest = _core.nearest_neighbors(places, np.ascontiguousarray(places[rows]), 2)
    others = np.where(nearest[:, 0] == rows, nearest[:, 1], nearest[:, 0])
    clear = facing[rows] & facing[others]
    if not clear.any():
        return 0.0, 1.0
    rows, others = rows[clear], others[clear]
    apart = _apart(points, directions, rows, others, spacings_around(points, rows))
    layered = apart > max(APART, DEVIATIONS_APART * noise)
    return float((layered & (apart <= DOUBLED)).mean()), float((layered & (apart > DOUBLED)).mean())


def _apart(
    points: Vectors, directions: Vectors, rows: NDArray[np.int64], others: NDArray[np.int64], spacings: Vectors
) -> Vectors:
    """Return how far the `others` (m,) lie off the planes of the `rows` (m,) and these off theirs, in spacings."""
    offsets = points[others] - points[rows]
    heights = np.stack([np.einsum("nc,nc->n", offsets, directions[ends]) for ends in (rows, others)])
    return np.asarray(abs(heights).min(axis=0) / spacings)


def _below(points: Vectors, directions: Vectors, noise: float, places: Vectors) -> NDArray[np.bool_]:
    """Return which points (n, 3) lie below one of those that are next to them as seen from above, (n,)."""
    rows = np.arange(len(points))
    spacings, below = spacings_around(points, rows), np.zeros(len(points), dtype=bool)
    for others in _core.nearest_neighbors(places, min(BESIDE, len(points) - 1)).T:
        apart = _apart(points, directions, rows, others, spacings)
        below |= (points[others, 2] > points[:, 2]) & (apart > max(APART, DEVIATIONS_BELOW * noise))
    return below


def spacings_around(points: Vectors, rows: NDArray[np.int64]) -> Vectors:
    """Return the spacing of the points (n, 3) around each of those of the `rows` (m,)."""
    count = min(SPACING_NEIGHBORS, len(points) - 1)
    last = _core.nearest_neighbors(points, np.ascontiguousarray(points[rows]), count + 1)[:, -1]
    return np.asarray(np.linalg.norm(points[last] - points[rows], axis=1) * np.sqrt(np.pi / count))
