# SPDX-License-Identifier: GPL-3.0-or-later
"""The points of a cloud that the other stages work on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hdpea.frontend.classifying import classify
from hdpea.options.cleaning import CleaningOptions
from hdpea.reading.cloud import PointCloud


@dataclass(frozen=True)
class SurfaceCloud:
    """A cloud of surface points only.

    Attributes
    ----------
    cloud
        The points that are left, in the order given.
    points_shown
        As many evenly spread points would show as much: what the numbers of vertices and particles go by.
    dropped_strays, dropped_on_lines
        How many points were left out, and why.
    notes
        Sentences for the user about it.
    """

    cloud: PointCloud
    points_shown: int
    dropped_strays: int = 0
    dropped_on_lines: int = 0
    notes: tuple[str, ...] = ()

    def counts(self) -> dict[str, int]:
        """Return how many points were left out, by name."""
        return {"dropped_strays": self.dropped_strays, "dropped_on_lines": self.dropped_on_lines}


def surface_cloud(cloud: PointCloud, options: CleaningOptions | None = None) -> SurfaceCloud:
    """Leave out of a cleaned cloud the points that lie on no surface, and those that crowd on scan lines."""
    options = options or CleaningOptions()
    if options.outliers == "none":
        return SurfaceCloud(cloud, len(cloud.points))
    found = classify(cloud.points)
    if found.kept.all():
        return SurfaceCloud(cloud, len(cloud.points))
    strays = int(found.strays.sum())
    on_lines = len(cloud.points) - strays - int(found.kept.sum())
    told = {
        f"Dropped points that lie on no surface: {strays:,}.": strays,
        f"Dropped points that crowd on scan lines: {on_lines:,}.": on_lines,
    }
    notes = tuple(note for note, count in told.items() if count)
    return SurfaceCloud(cloud.at(np.flatnonzero(found.kept)), found.shown, strays, on_lines, notes)
