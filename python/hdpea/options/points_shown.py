# SPDX-License-Identifier: GPL-3.0-or-later
"""What points can show, by which numbers of vertices and particles are chosen."""

from __future__ import annotations

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class PointsShown:
    """What the points of a cloud can show.

    Attributes
    ----------
    count
        How many evenly spread points would show as much.
    exact
        Whether the points are free of noise, and their normals their own: then more particles show more.
    denoised
        Whether the points were moved to where they are: then more particles tear less.
    """

    count: int
    exact: bool = True
    denoised: bool = False

    def of_share(self, share: float) -> PointsShown:
        """Return what this share of the points can show."""
        return replace(self, count=round(self.count * share))
