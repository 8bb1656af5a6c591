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
from hdpea.frontend.classes import stream_of_classes
from hdpea.mesh.extraction import Mesh
from hdpea.options import Options
from hdpea.options.choice import Choice
from hdpea.reading.streaming import PointStream
from hdpea.report.cost import points_within
from hdpea.report.measurement import mesh_facts, missed_targets
from hdpea.report.report import Journal, Report
from hdpea.result import Reconstruction
from hdpea.runtime.clock import Stage, StageClock
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.runtime.pytorch import check_pytorch
from hdpea.tiling.folder import WorkFolder
from hdpea.tiling.intake import take_in
from hdpea.tiling.measuring import measured
from hdpea.tiling.scheduling import run
from hdpea.tiling.tasks import Task, Took, tasks_of
from hdpea.tiling.work import Work
from hdpea.version import version

SHARES = 8
"""Tiles are as large as an eighth of the memory has room for: as many can be worked on at a time, and the tiles,
and with them the bytes, do not depend on the number of processes."""

HELD = 1.6
"""Memory of a process that works on tiles for each byte that a run of as many points takes in one piece, since it holds
what earlier tasks have freed: 1.22 GB with 344,000 points, 0.78 GB by the cost model."""

LEAST_SHARE = 1e9
"""Bytes that a tile may take in any case, if there are as many: 2,000,000 points of a knot in tiles of 84,000, which
have room in 0.6 GB, are known to 3.3 tiles each, in tiles of 340,000 to 1.3."""

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
        Most points in a tile, halo included; default: what its share of the memory holds.
    """

    folder: Path
    memory: float
    jobs: int = 1
    scheduler: str | None = None
    tile_points: int | None = None

    def most_points(self, options: Options, points: int) -> int:
        """Return how many points a tile may have, its halo included, of a cloud of so many."""
        if self.tile_points is not None:
            return self.tile_points
        return points_within(self._share / HELD, points / options.vertices_of(points))

    @property
    def workers(self) -> int:
        """How many processes work at a time."""
        if self.tile_points is not None:
            return self.jobs
        return max(min(self.jobs, int(self.memory / self._share)), 1)

    @property
    def _share(self) -> float:
        """Bytes that a tile may take."""
        return min(max(self.memory / SHARES, LEAST_SHARE), self.memory)


def reconstruct_in_tiles(
    stream: PointStream, tiling: Tiling, options: Options | None = None, progress: ProgressCallback | None = None
) -> Reconstruction:
    """Make a mesh of a cloud tile by tile, as ``hdpea.reconstruct`` does in one piece.

    The bytes of the mesh depend on the cloud, the options and the size of the tiles, not on who works on them.

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
    most = tiling.most_points(options, stream.count)
    with _work_folder(tiling.folder, f"{version()} {stream.identity} {options} {most}") as folder:
        tell(progress, "tiling", 0)
        classes = options.cleaning.classes
        if classes is not None:
            # Tiles know nothing of classes, but have the points of those alone.
            stream = stream_of_classes(stream, classes)
            options = replace(options, cleaning=replace(options.cleaning, classes=None))
        with journal.clock.stage("tiling"):
            plan = take_in(stream, folder, options, most)
        work = Work(folder, plan, options)
        tasks, after = tasks_of(work, options.threads or max((os.cpu_count() or 1) // tiling.workers, 1))
        with journal.clock.stage("tiles") as stage:
            for number, (index, took) in enumerate(run(tasks, after, tiling.workers, tiling.scheduler)):
                _credit(journal.clock, stage, tasks[index], took)
                tell(progress, "tiles", (number + 1) / len(tasks))
        return _result(stream, work, tiling, journal)


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
        raise UsageError(f"A cloud in tiles takes no {', '.join(refused)}.", "Give more `memory`, or leave that away.")


@contextmanager
def _work_folder(path: Path, key: str) -> Iterator[WorkFolder]:
    """Give a folder for work on what `key` tells, with what an earlier run has done of it; it vanishes in the end.

    After an error it stays, so that the next run goes on.
    """
    digest = hashlib.sha256(key.encode()).hexdigest()
    told = path / KEY
    if path.exists() and not (told.is_file() and told.read_text() == digest):
        if any(path.iterdir()) and not told.is_file():
            raise UsageError(f"The folder {path} is in use for something else.", "Name another folder for the work.")
        shutil.rmtree(path)
    try:
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


def _result(stream: PointStream, work: Work, tiling: Tiling, journal: Journal) -> Reconstruction:
    kept, facts = work.folder.load("mesh"), work.folder.facts("mesh")
    tiles = [work.folder.facts("prepared", tile) for tile in range(work.plan.tiles)]
    mesh = Mesh(kept["vertices"], kept["faces"], kept["vertices"], self_intersections=facts["self_intersections"])
    distances, agreement, error, along_z = measured(work)
    found = mesh_facts(mesh)
    journal.source["format"] = stream.format
    journal.counts |= {
        "points": sum(each["points"] for each in tiles),
        "dropped": sum(each["dropped"] for each in tiles),
        "normals_estimated": sum(each["estimated"] for each in tiles),
        "tiles": work.plan.tiles,
        "points_in_largest_tile": max(each["known"] for each in tiles),
        "workers": tiling.workers,
    }
    diagonal, agreed = work.plan.frame.diagonal, work.folder.facts("agreed")
    why = "beyond a tile, its points are known"
    journal.choices += [
        Choice("tiles", work.plan.tiles, "", "as few as their share of the memory allows"),
        Choice("halo", work.plan.halo * diagonal, "world units", why),
        Choice("vertices", agreed["vertices"], "", "of all tiles together"),
        Choice("particles", agreed["particles"], "", "of all tiles together"),
    ]
    journal.meshing |= facts["statistics"]
    journal.notes += [_note(stream, work), *dict.fromkeys(note for each in tiles for note in each["notes"])]
    if estimated := journal.counts["normals_estimated"]:
        journal.notes.append(f"Normals of {estimated:,} points were estimated.")
    journal.notes += facts["notes"]
    journal.missed += dict.fromkeys(why for each in tiles for why in each["missed"])
    journal.missed += [*missed_targets(mesh, found, work.options.meshing), *agreement.missed()]
    report = Report.of(journal, found, distances, agreement, error, along_z)
    return Reconstruction(work.plan.frame.to_world(mesh.vertices_in_unit), mesh.faces, report, crs=stream.crs)


def _note(stream: PointStream, work: Work) -> str:
    whole = "" if stream.streamed else "; the file was read whole, as its format has no streaming"
    return f"Made in {work.plan.tiles} tiles: colours and other attributes are left out{whole}."
