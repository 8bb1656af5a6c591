# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a run: what was asked, chosen, found and measured."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.options import Options
from hdpea.options.choice import Choice
from hdpea.options.settings import as_dict
from hdpea.report.achieved_error import AchievedError
from hdpea.report.agreement import Agreement
from hdpea.runtime.clock import StageClock
from hdpea.runtime.marks import mark_of
from hdpea.runtime.outputs import replacing
from hdpea.version import version


@dataclass(frozen=True)
class MeshFacts:
    """What kind of surface the mesh is; ``genus`` is None unless it is closed (and summed over components)."""

    vertices: int
    faces: int
    manifold: bool
    closed: bool
    components: int
    boundary_loops: int
    genus: int | None
    self_intersections: int


@dataclass(frozen=True)
class LevelFacts:
    """What a coarser level of the mesh is, and how far it is from the points, in world units.

    ``rms`` is the root mean square distance of the points as they were given, ``error`` the largest both ways, after
    any denoising: what is told of the mesh itself.
    """

    vertices: int
    faces: int
    rms: float
    error: float


@dataclass(frozen=True)
class Distances:
    """Distances from the points to the mesh, in world units and in spacings of the points."""

    spacing: float
    mean: float
    rms: float
    percentile_95: float
    max: float

    @classmethod
    def of(cls, distances: NDArray[np.float64], spacing: float) -> Distances:
        """Sum up the distance of each point (n,), n > 0, both in world units."""
        largest = float(distances.max())
        # Squares of very large and very small lengths are no doubles.
        shares = distances / largest if largest > 0 else distances
        return cls(
            spacing=float(spacing),
            mean=largest * float(shares.mean()),
            rms=largest * float(np.sqrt(np.mean(shares**2))),
            percentile_95=float(np.percentile(distances, 95)),
            max=largest,
        )

    def as_dict(self) -> dict[str, Any]:
        """Return both units side by side, fit for JSON."""
        in_world = {name: value for name, value in asdict(self).items() if name != "spacing"}
        in_spacings = {name: value / self.spacing for name, value in in_world.items()} if self.spacing > 0 else None
        return {"spacing": self.spacing, "in_world_units": in_world, "in_spacings": in_spacings}


@dataclass(frozen=True)
class HeightDifferences:
    """How far the points are above or below the mesh, along z and in world units.

    ``points`` are as many as have the mesh above or below them, ``others`` as many as have not.
    """

    points: int
    others: int
    rms: float
    percentile_95: float
    max: float

    @classmethod
    def of(cls, differences: NDArray[np.float64]) -> HeightDifferences | None:
        """Sum up those (n,) that are known, of either sign; the others are NaN. None if none is."""
        known = abs(differences[np.isfinite(differences)])
        if not len(known):
            return None
        found = Distances.of(known, 0.0)
        return cls(len(known), len(differences) - len(known), found.rms, found.percentile_95, found.max)


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
