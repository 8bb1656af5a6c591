# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run will need, before it is started."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Cost:
    """A cost that grows with the points and the vertices."""

    fixed: float
    per_thousand_points: float
    per_thousand_vertices: float

    def of(self, points: int, vertices: int) -> float:
        """Return the cost of making a mesh of so many vertices from so many points."""
        return self.fixed + (self.per_thousand_points * points + self.per_thousand_vertices * vertices) / 1000


SECONDS = Cost(fixed=2.0, per_thousand_points=0.11, per_thousand_vertices=0.7)
"""Wall-clock time of the whole command on two cores."""

PEAK_BYTES = Cost(fixed=0.6e9, per_thousand_points=5e6, per_thousand_vertices=10e6)
"""Peak resident memory of the process."""
