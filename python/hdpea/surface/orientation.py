# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of the surface is out: the ways of finding the signs of normals whose directions are known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import UnreadableInput, UsageError
from hdpea.options import NormalOptions
from hdpea.surface.roughness import Roughness

Vectors = NDArray[np.float64]

TRUSTED_CONSISTENCY = 0.9
"""Share of neighbours in agreement from which the file's orientation is taken as it is; random signs have 0.5."""

AGREEING_COSINE = 0.5
"""Least |cosine| with the winding number's normal at which a direction is taken for the same normal: 60 degrees."""

DEVIATIONS_WIDE = 1.6
"""Widening of the winding number for each standard deviation of the noise.

With less it sees single points, and beside the holes of scans half of a thick shell of noise turns inwards (boot, noise
of 0.5 % of the diagonal); with more the two sides of a wall are one (goblet_top, as much noise, from 2.0 on)."""

MOST_OF_WALLS = 0.15
"""Deviation, in spacings, from which what is not like noise widens no more: the sides of walls are to be parted."""


@dataclass(frozen=True)
class Unoriented:
    """Points, and normals whose signs mean nothing yet.

    Attributes
    ----------
    points, directions
        (n, 3) float64; the directions of length 1.
    estimated
        (n,) bool: which directions are estimates, not given.
    given
        (n, 3) float64: normals whose signs may be heard, of length 1, or 0 where there is none.
    neighbors
        (n, k) int64: nearest other points, -1 pads.
    roughness
        Of the points.
    """

    points: Vectors
    directions: Vectors
    estimated: NDArray[np.bool_]
    given: Vectors
    neighbors: NDArray[np.int64]
    roughness: Roughness

    @cached_property
    def consistency(self) -> float | None:
        """The share of neighbours whose given normals agree on the side; None if none is given."""
        if not self.given.any():
            return None
        return _core.orientation_consistency(self.points, self.given, self.neighbors)


@dataclass(frozen=True)
class Orientation:
    """Oriented unit normals (n, 3); the way they were oriented, one of ``NormalOptions.orient``; and why so."""

    normals: Vectors
    way: str
    why: str = ""


def require_signs(given: Vectors, sensors: Vectors | None, options: NormalOptions) -> None:
    """Refuse to orient by what is not there.

    Raises
    ------
    UnreadableInput
        If the file is to say the signs, or the sensors' positions, and does not.
    UsageError
        If there is no viewpoint to orient towards.
    """
    if options.orient == "file" and not given.any():
        raise UnreadableInput("There are no usable normals whose orientation to keep.", "Use --orient auto.")
    if options.orient == "viewpoint" and options.viewpoint is None:
        if sensors is None:
            raise UsageError(
                "There is no viewpoint to turn the normals to.",
                "Give --viewpoint X,Y,Z, or properties sensor_x, sensor_y and sensor_z in the file.",
            )
        if not np.isfinite(sensors).all():
            raise UnreadableInput("Not every point's sensor position is finite.", "Give one --viewpoint X,Y,Z.")


def orient(
    cloud: Unoriented, way: str, seen_from: Vectors | None = None, progress: Callable[[float], bool] | None = None
) -> Orientation:
    """Give normals their signs, in the given way of ``NormalOptions.orient``.

    Parameters
    ----------
    seen_from
        (n, 3) or (3,), the sensor of each point or of all; needed for the way ``viewpoint``.
    """
    if way == "auto":
        return _orient_as_fits(cloud, progress)
    if way == "wnnc":
        return Orientation(by_winding_number(cloud, progress), way)
    if way == "viewpoint" and seen_from is not None:
        return Orientation(turned(cloud.directions, seen_from - cloud.points), way)
    return Orientation(by_file(cloud) if way == "file" else by_spanning_tree(cloud), way)


def _orient_as_fits(cloud: Unoriented, progress: Callable[[float], bool] | None) -> Orientation:
    consistency = cloud.consistency
    if consistency is not None and consistency >= TRUSTED_CONSISTENCY:
        return Orientation(by_file(cloud), "file", f"{consistency:.0%} of neighbours agree on the side")
    ways = {"wnnc": by_winding_number(cloud, progress), "mst": by_spanning_tree(cloud)}
    agreed = {
        way: _core.orientation_consistency(cloud.points, normals, cloud.neighbors) for way, normals in ways.items()
    }
    # Noise and thin walls lead the spanning tree astray, large openings the winding number: then neighbours disagree.
    best, other = ("wnnc", "mst") if agreed["wnnc"] >= agreed["mst"] else ("mst", "wnnc")
    why = f"{agreed[best]:.2%} of neighbours agree on the side, by {other} {agreed[other]:.2%}"
    return Orientation(ways[best], best, why)


def by_file(cloud: Unoriented) -> Vectors:
    """Turn the directions as the given normals have it, and where there is none, as the nearest other has it."""
    signed = turned(cloud.directions, cloud.given)
    usable = np.asarray(cloud.given.any(axis=1))
    if usable.all():
        return signed
    oriented = by_spanning_tree(cloud)
    kept = cosines(oriented, signed)[usable] >= 0
    nearest_usable = _core.nearest_neighbors(cloud.points[usable], cloud.points[~usable], 1)[:, 0]
    signed[~usable] = np.where(kept[nearest_usable], 1, -1)[:, None] * oriented[~usable]
    return signed


def by_spanning_tree(cloud: Unoriented) -> Vectors:
    """Hand on the side from neighbour to neighbour, the surest first."""
    return _core.orient_normals(cloud.points, cloud.directions, cloud.neighbors)


def by_winding_number(cloud: Unoriented, progress: Callable[[float], bool] | None = None) -> Vectors:
    """Turn the directions as the winding number has it; estimates far off it are replaced by its own."""
    options, roughness = _core.WnncOptions(), cloud.roughness
    noise = roughness.deviation if roughness.like_noise else min(roughness.deviation, MOST_OF_WALLS)
    options.spacings_wide += DEVIATIONS_WIDE * noise
    winding = _core.wnnc_normals(cloud.points, options, progress)
    agreeing = abs(cosines(cloud.directions, winding)) >= AGREEING_COSINE
    signed = turned(cloud.directions, winding)
    # An estimate far off was fitted across an edge or a thin wall, which the winding number knows of.
    replaced = cloud.estimated & ~agreeing
    signed[replaced] = winding[replaced]
    # Beside large holes of the cloud it may be wrong about half a face: so faces vote.
    return _core.agree_on_signs(cloud.points, signed, cloud.neighbors)


def turned(directions: Vectors, towards: Vectors) -> Vectors:
    """Return the directions (n, 3), those flipped that point away from the vectors `towards` (n, 3)."""
    return np.where(cosines(directions, towards) < 0, -1, 1)[:, None] * directions


def cosines(a: Vectors, b: Vectors) -> Vectors:
    """Return the scalar products of the rows of two arrays (n, 3)."""
    return np.asarray(np.einsum("nc,nc->n", a, b))
