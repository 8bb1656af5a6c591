# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run needs of a machine, in one piece or in tiles."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Self

from hdpea.cli.tiles import Resources
from hdpea.errors import UsageError
from hdpea.options import Options
from hdpea.report.cost import (
    TILED_DISK_BYTES,
    TILED_SECONDS,
    TILED_WHOLE_BYTES,
    most_bytes,
    tiled_vertices_within,
)
from hdpea.report.inspection import CloudFacts
from hdpea.surface.surface import MIN_POINTS
from hdpea.tiling.run import Tiling, process_bytes

ONE_PIECE = "--error and colours are for one piece: cut a larger cloud yourself"


@dataclass(frozen=True)
class InTiles:
    """What a run in tiles needs, on two cores.

    Attributes
    ----------
    jobs
        Processes that the memory has room for, two at most.
    seconds
        Of the whole run.
    process_bytes, whole_bytes, disk_bytes
        Memory of each process, that for the whole mesh in the end, and what is taken of the disk meanwhile.
    """

    jobs: int
    seconds: float
    process_bytes: float
    whole_bytes: float
    disk_bytes: float

    @staticmethod
    def needed(facts: CloudFacts, resources: Resources) -> bool:
        """Return whether a run in one piece has too little memory, should it take the most that it may."""
        return facts.counts["points"] >= MIN_POINTS and _most(facts) > resources.bytes()

    @classmethod
    def of(cls, facts: CloudFacts, resources: Resources) -> Self | None:
        """Return what a mesh of the default size takes; None if there is too little memory for any tile."""
        points, vertices = facts.counts["points"], facts.default_vertices
        tiling = Tiling(Path(), resources.bytes(), jobs=2)
        try:
            tile_points, _ = tiling.sizes(Options(), points)
        except UsageError:
            return None
        return cls(
            jobs=tiling.workers(tile_points, points / vertices),
            seconds=TILED_SECONDS * points,
            process_bytes=process_bytes(tile_points, points / vertices),
            whole_bytes=TILED_WHOLE_BYTES.of(points, vertices),
            disk_bytes=TILED_DISK_BYTES * points,
        )


def needs(facts: CloudFacts, resources: Resources) -> str:
    """Return what a run needs, as a line."""
    points = facts.counts["points"]
    if points < MIN_POINTS:
        return f"at least {MIN_POINTS} points"
    cost = f"about {facts.estimated_seconds:.0f} s and {facts.estimated_peak_bytes / 1e9:.1f} GB"
    if (most := _most(facts)) > facts.estimated_peak_bytes:
        cost += f" (up to {most / 1e9:.1f}, since normals are estimated)"
    if InTiles.needed(facts, resources):
        return f"{_in_tiles(facts, resources)}; in one piece {cost}. {ONE_PIECE}"
    return f"{cost} for {facts.default_vertices:,} vertices, on two idle cores"


def _most(facts: CloudFacts) -> float:
    """Return the most memory that a run in one piece may take."""
    normals = bool(facts.counts["usable_normals"] and facts.normals_fit)
    return most_bytes(facts.estimated_peak_bytes, normals=normals)


def _in_tiles(facts: CloudFacts, resources: Resources) -> str:
    tiled = InTiles.of(facts, resources)
    if tiled is None:
        return "more memory than that, even in tiles"
    return (
        f"about {tiled.seconds:.0f} s in tiles with --jobs {tiled.jobs}, {tiled.process_bytes / 1e9:.1f} GB in each "
        f"process, {tiled.whole_bytes / 1e9:.1f} GB in the end for the whole mesh"
        f"{_fewer(tiled.whole_bytes, resources.bytes())}, and "
        f"{tiled.disk_bytes / 1e9:.1f} GB of the disk, for {facts.default_vertices:,} vertices"
    )


def _fewer(whole: float, memory: float) -> str:
    """Return for how many vertices there is memory in the end, if not for as many as take `whole` bytes."""
    thousands = tiled_vertices_within(memory) // 1000
    return f" ({memory / 1e9:.1f} GB with --vertices {thousands}000)" if whole > memory and thousands else ""
