# SPDX-License-Identifier: GPL-3.0-or-later
"""A cloud that is larger than memory, from its stream to its mesh."""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from hdpea.errors import UsageError
from hdpea.frontend.classes import stream_of_classes, taken_note
from hdpea.frontend.cleaning import dropped_notes
from hdpea.frontend.heaps import missing_with_heaps
from hdpea.mesh.extraction import Mesh
from hdpea.options import Options
from hdpea.reading.streaming import PointStream
from hdpea.report.cost import PEAK_BYTES, points_within
from hdpea.report.measurement import in_spacings_of_vertices, mesh_facts, missed_targets, missing_part
from hdpea.report.report import Journal, Report
from hdpea.result import Reconstruction
from hdpea.runtime.clock import Stage, StageClock
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.runtime.pytorch import check_pytorch
from hdpea.surface.surface import MIN_POINTS
from hdpea.tiling.choices import choices_of
from hdpea.tiling.folder import WorkFolder
from hdpea.tiling.intake import take_in
from hdpea.tiling.measuring import measured
from hdpea.tiling.plan import TILE_POINTS
from hdpea.tiling.scheduling import run
from hdpea.tiling.tasks import Task, Took, tasks_of
from hdpea.tiling.work import Work
from hdpea.version import version

HELD = 1.1
"""Memory of a process that works on tiles for each byte that a run of as many points takes in one piece, since it holds
what earlier tasks have freed: 1.22 GB with 344,000 points, 1.15 GB by the cost model."""

KEY = "hdpea-tiles.key"
"""File by which a work folder is known to be one, and of what."""


@dataclass(frozen=True)
class Tiling:
    """How a cloud is worked on in tiles.

    Attributes
    ----------
    folder
        Where tiles and results are kept meanwhile; a run that was killed goes on with what is there.
    memory
        Bytes that all processes together may take.
    jobs
        Processes on this machine, at most; fewer, if the memory has no room for as many tiles.
    scheduler
        Address of a Dask scheduler, in place of these.
    tile_points
        Most points in a tile, halo included; default: ``TILE_POINTS``, or fewer if the memory has no room for as many.
    """

    folder: Path
    memory: float
    jobs: int = 1
    scheduler: str | None = None
    tile_points: int | None = None

    def sizes(self, options: Options, points: int) -> tuple[int, int]:
        """Return how many points a tile is to have, its halo included, and may have, of a cloud of so many.

        Raises
        ------
        UsageError
            If the memory has no room for any.
        """
        if self.tile_points is not None:
            return self.tile_points, self.tile_points
        room = points_within(self.memory / HELD, points / options.vertices_of(points))
        if room < MIN_POINTS:
            raise UsageError("There is too little memory for tiles of any size.", "Give more `memory`.")
        return min(TILE_POINTS, room), room

    def workers(self, tile_points: int, points_per_vertex: float) -> int:
        """Return how many processes work at a time on tiles of so many points."""
        if self.tile_points is not None:
            return self.jobs
        return max(min(self.jobs, int(self.memory / process_bytes(tile_points, points_per_vertex))), 1)


def process_bytes(tile_points: int, points_per_vertex: float) -> float:
    """Return the memory of a process that works on tiles of so many points."""
    return HELD * PEAK_BYTES.of(tile_points, round(tile_points / points_per_vertex))


def reconstruct_in_tiles(
    stream: PointStream, tiling: Tiling, options: Options | None = None, progress: ProgressCallback | None = None
) -> Reconstruction:
    """Make a mesh of a cloud tile by tile, as ``hdpea.reconstruct`` does in one piece.

    The bytes of the mesh depend on the cloud and the options, not on who works on the tiles; nor on the memory, unless
    it has no room for tiles of the usual size, which the report tells.

    Raises
    ------
    UsageError
        If options ask for what tiles do not have, or tiles of this size cannot be cut.
    CannotReconstruct, UnreadableInput, HdpeaError
        As of ``hdpea.reconstruct``, or if a task fails again and again.
    """
    options = options or Options()
    _check(options)
    check_pytorch()
    journal = Journal(options=options)
    size, most = tiling.sizes(options, stream.count)
    with _work_folder(tiling.folder, f"{version()} {stream.identity} {options} {size}") as folder:
        tell(progress, "tiling", 0)
        classes = options.cleaning.classes
        if classes is not None:
            # Tiles know nothing of classes, but have the points of those alone.
            stream = stream_of_classes(stream, classes)
            options = replace(options, cleaning=replace(options.cleaning, classes=None))
        with journal.clock.stage("tiling"):
            plan = take_in(stream, folder, options, size, most)
        if classes is not None:
            journal.notes.append(taken_note(plan.points, stream.count, classes))
        work = Work(folder, plan, options)
        workers = tiling.workers(plan.tile_points, plan.points / options.vertices_of(plan.points))
        tasks, after = tasks_of(work, options.threads or max((os.cpu_count() or 1) // workers, 1))
        with journal.clock.stage("tiles") as stage:
            for number, (index, took) in enumerate(run(tasks, after, workers, tiling.scheduler)):
                _credit(journal.clock, stage, tasks[index], took)
                tell(progress, "tiles", (number + 1) / len(tasks))
        journal.counts["workers"] = workers
        return _result(stream, work, journal)


def _check(options: Options) -> None:
    """Refuse what tiles do not have."""
    asked = {
        "error": options.meshing.error,
        "lod": options.meshing.lod > 1,
        "texture": options.texture,
        "watertight": options.meshing.watertight,
    }
    refused = [f"`{name}`" for name, value in asked.items() if value]
    if refused:
        hint = "Give more `memory`, leave that away, or cut the cloud into pieces."
        raise UsageError(f"A cloud in tiles takes no {', '.join(refused)}.", hint)


@contextmanager
def _work_folder(path: Path, key: str) -> Iterator[WorkFolder]:
    """Give a folder for work on what `key` tells, with what an earlier run has done of it; it vanishes in the end.

    After an error it stays, so that the next run goes on.
    """
    digest = hashlib.sha256(key.encode()).hexdigest()
    told = path / KEY
    if path.exists() and not path.is_dir():
        raise UsageError(f"{path} is a file, no folder to work in.", "Name a folder for the work.")
    try:
        if path.exists() and not (told.is_file() and told.read_text() == digest):
            if any(path.iterdir()) and not told.is_file():
                raise UsageError(
                    f"The folder {path} is in use for something else.", "Name another folder for the work."
                )
            shutil.rmtree(path)
        path.mkdir(parents=True, exist_ok=True)
        told.write_text(digest)
    except OSError as error:
        raise UsageError(f"Cannot work in the folder {path}: {error.strerror}.", "Choose another.") from error
    yield WorkFolder(path)
    shutil.rmtree(path)


def _credit(clock: StageClock, within: Stage, task: Task, took: Took) -> None:
    """Add what a task has taken to the stage that it belongs to: its processor time, and its peak of memory."""
    stage = next((each for each in clock.stages if each.name == task.stage and each.level == 1), None)
    if stage is None:
        stage = Stage(task.stage, 1)
        clock.stages.append(stage)
    stage.seconds += took.cpu_seconds
    for each in (stage, within):
        each.peak_bytes = max(each.peak_bytes, took.peak_bytes)


def _result(stream: PointStream, work: Work, journal: Journal) -> Reconstruction:
    kept, facts = work.folder.load("mesh"), work.folder.facts("mesh")
    tiles = [work.folder.facts("prepared", tile) for tile in range(work.plan.tiles)]
    mesh = Mesh(kept["vertices"], kept["faces"], kept["vertices"], self_intersections=facts["self_intersections"])
    distances, agreement, error, along_z = measured(work)
    found = mesh_facts(mesh)
    journal.take_source(stream.format, stream.crs)
    journal.counts |= {
        "points": sum(each["points"] for each in tiles),
        "normals_estimated": sum(each["estimated"] for each in tiles),
        "tiles": work.plan.tiles,
        "points_in_largest_tile": max(each["known"] for each in tiles),
    }
    dropped = {name: sum(each["dropped"][name] for each in tiles) for name in tiles[0]["dropped"]}
    journal.counts |= dropped
    journal.choices += choices_of(work)
    journal.meshing |= facts["statistics"]
    journal.notes += [_note(stream, work), *dropped_notes(dropped, work.plan.points)]
    journal.notes += dict.fromkeys(note for each in tiles for note in each["notes"])
    if estimated := journal.counts["normals_estimated"]:
        journal.notes.append(f"Normals of {estimated:,} points were estimated.")
    journal.notes += facts["notes"]
    farthest = in_spacings_of_vertices(error.points_to_mesh / work.plan.frame.diagonal, mesh)
    left_out = facts["statistics"].get("dropped_components", 0)
    journal.notes += missing_part(distances, farthest, agreement.points_without_mesh, left_out)
    journal.missed += missing_with_heaps(sum(each["in_heaps"] for each in tiles), work.plan.points)
    journal.missed += dict.fromkeys(why for each in tiles for why in each["missed"])
    journal.missed += [*missed_targets(mesh, found, work.options.meshing), *agreement.missed()]
    report = Report.of(journal, found, distances, agreement, error, along_z)
    return Reconstruction(work.plan.frame.to_world(mesh.vertices_in_unit), mesh.faces, report, crs=stream.crs)


def _note(stream: PointStream, work: Work) -> str:
    whole = "" if stream.streamed else "; the file was read whole, as its format has no streaming"
    small = ""
    if work.plan.tile_points < TILE_POINTS:
        room = f"{work.plan.tile_points:,} points at most instead of {TILE_POINTS:,}"
        small = f" They have {room}, which changes the mesh a little."
    tiles = f"{work.plan.tiles} tile{'s' if work.plan.tiles > 1 else ''}"
    return f"Made in {tiles}: colours and other attributes are left out{whole}.{small}"
