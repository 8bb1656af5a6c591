# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run will need, before it is started."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Cost:
    """A cost that grows with the points and the vertices, somewhat faster than they do."""

    fixed: float
    per_thousand_points: float
    per_thousand_vertices: float
    points_power: float = 1.0
    vertices_power: float = 1.0

    def of(self, points: int, vertices: int) -> float:
        """Return the cost of making a mesh of so many vertices from so many points."""
        for_points: float = self.per_thousand_points * (points / 1000) ** self.points_power
        for_vertices: float = self.per_thousand_vertices * (vertices / 1000) ** self.vertices_power
        return self.fixed + for_points + for_vertices


# Fitted by benchmarks/cost_fit.py to runs in one piece on clouds of 10,000 to 4,000,000 points with normals, and 10,000
# to 1,000,000 without, with 1,250 to 500,000 vertices, those of docs/performance.md.
PROCESSOR_SECONDS = Cost(fixed=3.1, per_thousand_points=0.0749, per_thousand_vertices=0.0417, vertices_power=1.45)
"""Processor time of the whole command, all threads together."""

ON_TWO_CORES = 0.7
"""Seconds on two idle cores for each of the processor: 0.65 of 4,000,000 points to 0.73 of 40,000."""

PEAK_BYTES = Cost(fixed=260e6, per_thousand_points=2.43e6, per_thousand_vertices=0.684e6)
"""Peak resident memory of the process."""


WITHOUT_NORMALS = 1.4
"""How many times as much memory a cloud may take whose normals are estimated: 1.37 times of a lidar tile."""

TILED_SECONDS = 0.1e-3
"""Seconds for each point of a cloud in tiles, on two cores, whether one process has both or two have one each: 142 s
for the 1,459,800 ground points of a flight; 0.137 ms of a processor of 10,000,000 (``docs/scaling.md``)."""

TILED_WHOLE_BYTES = Cost(fixed=0.3e9, per_thousand_points=0, per_thousand_vertices=2.75e6)
"""Memory for the mesh of all tiles, which one process extracts, repairs and measures: 988 MB for 250,000 vertices and
1,486 to 1,654 MB for 500,000 (``docs/scaling.md``)."""

TILED_DISK_BYTES = 605
"""Bytes of the disk for each point of a cloud in tiles, while they are worked on (``docs/scaling.md``)."""


def seconds_of_run(points: int, vertices: int) -> float:
    """Return the seconds of a run on two idle cores."""
    return ON_TWO_CORES * PROCESSOR_SECONDS.of(points, vertices)


def most_bytes(estimated: float, *, normals: bool) -> float:
    """Return the most memory that a run in one piece may take of which so much is expected.

    Parameters
    ----------
    normals
        Whether the cloud has normals that are used.
    """
    return estimated if normals else WITHOUT_NORMALS * estimated


def points_within(memory: float, points_per_vertex: float) -> int:
    """Return the points of the largest cloud that a run has room for in so many bytes, at so many points per vertex."""
    each = PEAK_BYTES.per_thousand_points + PEAK_BYTES.per_thousand_vertices / points_per_vertex
    return max(int(1000 * (memory - PEAK_BYTES.fixed) / each), 0)


def tiled_vertices_within(memory: float) -> int:
    """Return the vertices of the largest mesh of tiles that so many bytes have room for."""
    return max(int(1000 * (memory - TILED_WHOLE_BYTES.fixed) / TILED_WHOLE_BYTES.per_thousand_vertices), 0)
