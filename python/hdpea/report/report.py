# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a run: what was asked, chosen, found and measured."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np

from hdpea.options import Options
from hdpea.options.choice import Choice
from hdpea.options.settings import as_dict
from hdpea.report.achieved_error import AchievedError
from hdpea.report.agreement import Agreement
from hdpea.report.facts import Distances, HeightDifferences, LevelFacts, MeshFacts
from hdpea.runtime.clock import StageClock
from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import replacing
from hdpea.version import version


@dataclass(kw_only=True)
class Journal:
    """What a run takes down stage by stage.

    Attributes
    ----------
    options
        What was asked; the seed is among them.
    source
        What was read: the format, and the name if the command line read it.
    counts
        How many points there were, how many were dropped and why, how many had normals, by name.
    choices
        Every value that was chosen automatically.
    meshing
        T3, T12, refused triangles, holes, the share of the area that fills these and so on, by name.
    levels
        The coarser levels of the mesh, finest first.
    notes
        Sentences for the user: what is unusual about this input or this result.
    missed
        Sentences saying which wishes were not met; any of them makes the command end with exit code 5.
    clock
        Times and peak memory, stage by stage.
    """

    options: Options
    source: dict[str, Any] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    choices: list[Choice] = field(default_factory=list)
    meshing: dict[str, int | float] = field(default_factory=dict)
    levels: list[LevelFacts] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    missed: list[str] = field(default_factory=list)
    clock: StageClock = field(default_factory=StageClock)

    def take_source(self, format: str, crs: str | None) -> None:
        """Take down what was read: its format, and its coordinate reference system if it says one."""
        self.source |= {"format": format} | ({} if crs is None else {"crs": crs})


@dataclass(kw_only=True)
class Report(Journal):
    """The journal of a run that succeeded, and what came out of it."""

    mesh: MeshFacts
    distances: Distances
    agreement: Agreement
    error: AchievedError
    along_z: HeightDifferences | None = None

    @classmethod
    def of(
        cls,
        journal: Journal,
        mesh: MeshFacts,
        distances: Distances,
        agreement: Agreement,
        error: AchievedError,
        along_z: HeightDifferences | None = None,
    ) -> Report:
        """Close the journal; both go on sharing its lists and its clock."""
        taken_down = {each.name: getattr(journal, each.name) for each in fields(journal)}
        return cls(**taken_down, mesh=mesh, distances=distances, agreement=agreement, error=error, along_z=along_z)

    def begin_with(self, name: str, clock: StageClock) -> None:
        """Put the reading of the input, and what it took, before everything else."""
        self.source = {"name": name} | self.source
        self.clock.stages[:0] = clock.stages

    def as_dict(self) -> dict[str, Any]:
        """Return the whole report, fit for JSON."""
        return {
            "generator": mark_of("report"),
            "version": version(),
            "options": as_dict(self.options),
            "source": self.source,
            "counts": self.counts,
            "choices": [asdict(choice) for choice in self.choices],
            "meshing": self.meshing,
            "mesh": asdict(self.mesh),
            "distances": self.distances.as_dict() | {"along_z": self.along_z and asdict(self.along_z)},
            "agreement": asdict(self.agreement),
            "error": asdict(self.error),
            "levels": [asdict(level) for level in self.levels],
            "notes": self.notes,
            "missed": self.missed,
            "stages": [asdict(stage) for stage in self.clock.stages],
            "total": asdict(self.clock.total()),
        }

    def write(self, path: str | Path) -> None:
        """Write the report as JSON, whole or not at all.

        Raises
        ------
        UsageError
            If the file cannot be written.
        """
        with replacing(Path(path)) as partial:
            partial.write_text(json.dumps(self.as_json(), indent=2) + "\n")

    def as_json(self) -> dict[str, Any]:
        """Return the whole report of nothing but what JSON knows."""
        # JSON has no NaN, and a report must not fail for one: it becomes null.
        strict: dict[str, Any] = json.loads(json.dumps(self.as_dict(), default=_plain), parse_constant=lambda _: None)
        return strict


def _plain(value: Any) -> Any:
    """Turn numpy's numbers into Python's, which is all that JSON knows."""
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} does not fit into a report")
