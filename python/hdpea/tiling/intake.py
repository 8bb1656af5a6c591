# SPDX-License-Identifier: GPL-3.0-or-later
"""From a stream of points to a file of points for each tile, its halo included."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import Options
from hdpea.reading.cloud import PointCloud
from hdpea.reading.streaming import CHUNK, PointStream
from hdpea.tiling.cells import Cells, rows_of
from hdpea.tiling.folder import WorkFolder
from hdpea.tiling.plan import Plan, plan_tiles

COLUMNS = 9
"""Of the rows that are kept: a point, its normal, or zeros, and the place of its sensor, or no numbers."""


def take_in(stream: PointStream, folder: WorkFolder, options: Options, tile_points: int, most_points: int) -> Plan:
    """Write the points of each tile into the work folder, unless they are there; return the plan.

    `tile_points` and `most_points` are those of ``plan_tiles``.

    Raises
    ------
    UnreadableInput
        If no point is finite.
    UsageError
        If such tiles cannot be cut.
    """
    if folder.has("plan"):
        return _kept_plan(folder)
    rows = folder.path / "points.f64"
    frame, count = _write_rows(stream, rows)
    cells = Cells.of(frame.to_unit(chunk[:, :3]) for chunk in _chunks(rows, count))
    plan = plan_tiles(cells, frame, options, tile_points, most_points)
    _distribute(rows, cells, plan, folder)
    rows.unlink()
    _keep_plan(plan, folder)
    return plan


def tile_cloud(folder: WorkFolder, plan: Plan, tile: int) -> PointCloud:
    """Return the points of a tile and its halo, as they were read; normals if any has one, sensors if all have."""
    rows = np.fromfile(_tile_file(folder, tile)).reshape(-1, COLUMNS)
    rows = rows[plan.inside(tile, plan.frame.to_unit(rows[:, :3]), plan.halo)]  # cells reach farther
    points, normals, sensors = (np.ascontiguousarray(each) for each in np.split(rows, 3, axis=1))
    known = {"sensor": sensors} if np.isfinite(sensors).all() else {}
    return PointCloud(points, normals if normals.any() else None, known)


def _write_rows(stream: PointStream, path: Path) -> tuple[UnitFrame, int]:
    """Write the finite points one after the other; return the frame around them, and how many there are."""
    low, high, count = np.full(3, np.inf), np.full(3, -np.inf), 0
    with path.open("wb") as file:
        for chunk in stream.chunks():
            rows = np.zeros((len(chunk.points), COLUMNS))
            rows[:, :3] = chunk.points
            if chunk.normals is not None:
                rows[:, 3:6] = chunk.normals
            sensors = chunk.sensors()
            rows[:, 6:] = np.nan if sensors is None else sensors
            rows = rows[np.isfinite(rows[:, :3]).all(axis=1)]
            rows.tofile(file)
            count += len(rows)
            if len(rows):
                low, high = np.minimum(low, rows[:, :3].min(axis=0)), np.maximum(high, rows[:, :3].max(axis=0))
    if count == 0:
        raise UnreadableInput(f"Cannot read {stream.name}: none of its points is finite.")
    return UnitFrame.around(np.stack([low, high])), count


def _chunks(path: Path, count: int) -> Iterator[NDArray[np.float64]]:
    table = np.memmap(path, np.float64, "r", shape=(count, COLUMNS))
    for start in range(0, count, CHUNK):
        yield np.array(table[start : start + CHUNK])


def _tile_file(folder: WorkFolder, tile: int) -> Path:
    return folder.path / f"points.{tile}.f64"


def _distribute(rows: Path, cells: Cells, plan: Plan, folder: WorkFolder) -> None:
    """Append every row to the files of all tiles that know the cell of its point."""
    known = [np.flatnonzero(cells.in_box(plan.low[t] - plan.halo, plan.high[t] + plan.halo)) for t in range(plan.tiles)]
    tiles_of = np.repeat(np.arange(plan.tiles), [len(each) for each in known])
    cells_of = np.concatenate(known)
    order = np.argsort(cells_of, kind="stable")
    tiles_of = tiles_of[order]
    starts = np.searchsorted(cells_of[order], np.arange(len(cells.counts) + 1))
    for tile in range(plan.tiles):
        _tile_file(folder, tile).unlink(missing_ok=True)
    for chunk in _chunks(rows, plan.points):
        at = rows_of(cells, plan.frame.to_unit(chunk[:, :3]))
        counts = starts[at + 1] - starts[at]
        row = np.repeat(np.arange(len(chunk)), counts)
        within = np.arange(len(row)) - np.repeat(counts.cumsum() - counts, counts)
        tile = tiles_of[np.repeat(starts[at], counts) + within]
        by_tile = np.argsort(tile, kind="stable")
        ends = np.searchsorted(tile[by_tile], np.arange(plan.tiles + 1))
        for number in np.unique(tile):
            with _tile_file(folder, int(number)).open("ab") as file:
                chunk[row[by_tile[ends[number] : ends[number + 1]]]].tofile(file)


def _keep_plan(plan: Plan, folder: WorkFolder) -> None:
    arrays = {"low": plan.low, "high": plan.high, "neighbors": plan.neighbors, "centre": plan.frame.centre_in_world}
    facts = {"points": plan.points, "halo": plan.halo, "diagonal": plan.frame.diagonal}
    facts["tile_points"] = plan.tile_points
    folder.save("plan", None, arrays, facts)


def _kept_plan(folder: WorkFolder) -> Plan:
    arrays, facts = folder.load("plan"), folder.facts("plan")
    frame = UnitFrame(arrays["centre"], facts["diagonal"])
    boxes = arrays["low"], arrays["high"]
    return Plan(frame, facts["points"], *boxes, facts["halo"], arrays["neighbors"], facts["tile_points"])
