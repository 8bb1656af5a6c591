# SPDX-License-Identifier: GPL-3.0-or-later
"""The points of a cloud that the other stages work on."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import core_errors_translated
from hdpea.frontend.classes import of_classes
from hdpea.frontend.classifying import classify
from hdpea.frontend.crowds import crowd_means
from hdpea.frontend.heaps import missing_with_heaps
from hdpea.frontend.precision import precision_note
from hdpea.geometry.spatial_order import spatial_order
from hdpea.options.cleaning import CleaningOptions
from hdpea.reading.cloud import PointCloud

MANY = 0.05
"""Share of strays from which they are said to be many."""

STRAY, ON_LINES = 1, 2
"""Reasons for which points are dropped, as ``--dropped`` writes them."""


@dataclass(frozen=True)
class DroppedPoints:
    """Points of a cloud that were left out.

    Attributes
    ----------
    points
        (m, 3) float64 in world units, in the order given.
    reasons
        (m,) uint8: 1 for a point that lies on no surface, 2 for one that crowds on scan lines.
    in_heaps
        (m,) bool: strays that may be surface after all, as of ``Classified``.
    """

    points: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 3)))
    reasons: NDArray[np.uint8] = field(default_factory=lambda: np.empty(0, dtype=np.uint8))
    in_heaps: NDArray[np.bool_] = field(default_factory=lambda: np.empty(0, dtype=np.bool_))

    def counts(self, among: NDArray[np.bool_] | None = None) -> dict[str, int]:
        """Return how many there are for each reason, by name: of all, or `among` some, (m,) bool."""
        reasons = self.reasons if among is None else self.reasons[among]
        return {"dropped_strays": int((reasons == STRAY).sum()), "dropped_on_lines": int((reasons == ON_LINES).sum())}


@dataclass(frozen=True)
class SurfaceCloud:
    """A cloud of surface points only.

    Attributes
    ----------
    cloud
        The points that are left, in the order given; those of a crowd stand at its mean.
    on_surface
        All points but the strays, where they were given.
    points_shown
        As many evenly spread points would show as much: what the numbers of vertices and particles go by.
    spacing
        How far apart the surface is sampled, in the sparser direction: the median; None where it was not looked.
    dropped
        The points that were left out, and why.
    notes
        Sentences for the user about it.
    missed
        Sentences on what is missing from it, so that no mesh of it is what was wanted.
    """

    cloud: PointCloud
    on_surface: PointCloud
    points_shown: int
    spacing: float | None = None
    dropped: DroppedPoints = field(default_factory=DroppedPoints)
    notes: tuple[str, ...] = ()
    missed: tuple[str, ...] = ()

    def in_order_of_space(self) -> PointCloud:
        """Return the points that are left so that near ones stand near each other: what follows is faster.

        The order is that of these points alone, so that strays make no difference to it, to the last bit.
        """
        return self.cloud.at(spatial_order(self.cloud.points))

    def counts(self) -> dict[str, int]:
        """Return how many points were left out, by name."""
        return self.dropped.counts()


def surface_cloud(cloud: PointCloud, options: CleaningOptions | None = None) -> SurfaceCloud:
    """Leave out of a cleaned cloud what lies on no surface, and merge what crowds on scan lines.

    Raises
    ------
    UsageError
        If classes are asked for that there are not.
    """
    options = options or CleaningOptions()
    if options.classes is not None:
        cloud = of_classes(cloud, options.classes)
    with core_errors_translated():
        rounded = precision_note(cloud.points)
    notes = () if rounded is None else (rounded,)
    if options.outliers == "none":
        return SurfaceCloud(cloud, cloud, len(cloud.points), notes=notes)
    found = classify(cloud.points)
    known = found.spacing[found.kept & (found.spacing > 0)]
    spacing = float(np.median(known)) if len(known) else None
    if found.kept.all():
        return SurfaceCloud(cloud, cloud, len(cloud.points), spacing, notes=notes)
    left = cloud.at(np.flatnonzero(found.kept))
    gone = np.flatnonzero(~found.kept)
    reasons = np.where(found.strays[gone], STRAY, ON_LINES).astype(np.uint8)
    on_surface = left
    if (reasons == ON_LINES).any():
        on_surface = cloud.at(np.flatnonzero(~found.strays))
        left = replace(left, points=crowd_means(cloud.points, found.kept, found.stands_for))
    dropped = DroppedPoints(cloud.points[gone], reasons, found.in_heaps[gone])
    notes = (*notes, *dropped_notes(dropped.counts(), len(cloud.points)))
    missed = missing_with_heaps(int(dropped.in_heaps.sum()), len(cloud.points))
    return SurfaceCloud(left, on_surface, found.shown, spacing, dropped, notes, missed)


def dropped_notes(counts: dict[str, int], of: int) -> list[str]:
    """Return sentences about points that were left out `of` so many."""
    strays, on_lines = counts["dropped_strays"], counts["dropped_on_lines"]
    notes = []
    if strays:
        share = strays / of
        many = f", {share:.0%} of all: see that they are no part of it" if share > MANY else ""
        notes.append(f"Dropped points that lie on no surface: {strays:,}{many}.")
    if on_lines:
        notes.append(f"Dropped points that crowd on scan lines, or at one place: {on_lines:,}.")
    return notes
