# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of a tiled reconstruction, and which must be done before which."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hdpea.errors import core_errors_translated
from hdpea.mesh.repair import repair_mesh
from hdpea.mesh.sides import facing_out
from hdpea.report.measurement import mesh_facts
from hdpea.runtime.clock import StageClock, cpu_seconds
from hdpea.runtime.threads import limited_threads
from hdpea.tiling.agreeing import agree
from hdpea.tiling.finishing import finish, finished_mesh, merge
from hdpea.tiling.joining import join, propose
from hdpea.tiling.measuring import measure
from hdpea.tiling.preparing import embed, prepare
from hdpea.tiling.spreading import spread
from hdpea.tiling.work import Work


@dataclass(frozen=True)
class Task:
    """One step, of one tile or of the whole: a function of the work, whose result is a file.

    Attributes
    ----------
    stage
        One of ``STAGES``.
    number
        Of the tile, or of the colour of ``merging``; None for a step of the whole.
    threads
        To use; 0: all cores.
    """

    work: Work
    stage: str
    number: int | None = None
    threads: int = 0

    @property
    def done(self) -> bool:
        """Whether its result is there."""
        name, _ = STAGES[self.stage]
        # The first mesh is that of all particles, each colour of tiles makes another, the last has no number.
        steps = {"meshing": 0, "merging": (self.number or 0) + 1}
        return self.work.folder.has(name, steps.get(self.stage, self.number))


@dataclass(frozen=True)
class Took:
    """What a task has taken: processor time of its process meanwhile, and the peak of its memory."""

    cpu_seconds: float
    peak_bytes: int


def repair(work: Work) -> None:
    """Mend faces that cut others, turn pieces that are inside out, and check the whole."""
    mesh, agreed = finished_mesh(work), work.folder.facts("agreed")
    notes: tuple[str, ...] = ()
    if agreed["computed_sides"]:
        faced = facing_out(mesh)
        mesh, notes = faced.mesh, faced.notes
    # Its vertices are fitted to the points, and far fewer than these, which need not fit into the memory.
    mesh = repair_mesh(mesh, mesh.vertices_in_unit, exact=agreed["exact"])
    found = mesh_facts(mesh)
    arrays = {"vertices": mesh.vertices_in_unit, "faces": mesh.faces, "patches": mesh.patches}
    facts = {"self_intersections": found.self_intersections, "statistics": mesh.statistics, "notes": list(notes)}
    work.folder.save("mesh", None, arrays, facts)


STAGES: dict[str, tuple[str, Callable[..., None]]] = {
    "normals": ("prepared", prepare),
    "agreeing": ("agreed", agree),
    "embedding": ("embedded", embed),
    "particles": ("particles", spread),
    "triangles": ("triangles", propose),
    "meshing": ("mesh", join),
    "finishing": ("finished", finish),
    "merging": ("mesh", merge),
    "repair": ("mesh", repair),
    "measuring": ("measured", measure),
}
"""Each stage by name: what its results are called, and what does it."""


def perform(task: Task) -> Took:
    """Do a task, unless its result is there already."""
    started = cpu_seconds()
    with StageClock().stage(task.stage) as stage:
        if not task.done:
            _, function = STAGES[task.stage]
            with limited_threads(task.threads), core_errors_translated():
                function(task.work, *([] if task.number is None else [task.number]))
    return Took(cpu_seconds() - started, stage.peak_bytes)


def tasks_of(work: Work, threads: int) -> tuple[list[Task], list[set[int]]]:
    """Return all tasks in an order in which they can be done, and for each the numbers of those it must wait for."""
    tasks, after = list[Task](), list[set[int]]()
    number = dict[tuple[str, int | None], int]()
    tiles, colors = range(work.plan.tiles), work.plan.colors()

    def add(stage: str, which: int | None, *earlier: tuple[str, int | None]) -> None:
        number[stage, which] = len(tasks)
        tasks.append(Task(work, stage, which, threads))
        after.append({number[each] for each in earlier})

    def all_of(stage: str) -> list[tuple[str, int | None]]:
        return [(stage, tile) for tile in tiles]

    for tile in tiles:
        add("normals", tile)
    add("agreeing", None, *all_of("normals"))
    for tile in tiles:
        add("embedding", tile, ("agreeing", None))
    for tile in np.argsort(colors, kind="stable").tolist():
        add("particles", tile, *all_of("embedding"), *(("particles", each) for each in work.plan.earlier(tile)))
    for tile in tiles:
        around = np.flatnonzero(work.plan.neighbors[tile]).tolist()
        add("triangles", tile, *(("particles", each) for each in [tile, *around]))
    add("meshing", None, *all_of("triangles"))
    before: tuple[str, int | None] = ("meshing", None)
    for color in range(int(colors.max()) + 1):
        same = np.flatnonzero(colors == color).tolist()
        for tile in same:
            add("finishing", tile, before)
        add("merging", color, *(("finishing", tile) for tile in same))
        before = ("merging", color)
    add("repair", None, before)
    for tile in tiles:
        add("measuring", tile, ("repair", None))
    return tasks, after
