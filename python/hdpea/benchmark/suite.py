# SPDX-License-Identifier: GPL-3.0-or-later
"""A suite: models, inputs made from them, methods, numbers of vertices. ``suite_file`` reads it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hdpea.benchmark.methods import method_options
from hdpea.dataset.options import DegradationOptions, SampleOptions, ScanOptions
from hdpea.errors import UsageError
from hdpea.evaluation.normalization import LONGEST_SIDE, NORMALIZATIONS
from hdpea.evaluation.options import EvaluationOptions
from hdpea.options import Checked, option

MESH, HELD_OUT = "mesh", "held_out"


@dataclass(frozen=True)
class SuiteOptions(Checked):
    """The options common to all runs of a suite."""

    title: str = option("", "title, in a line")
    meshes: str = option("", "folder of the models, relative to the suite; those that a run is given take precedence")
    truth: str = option(
        MESH,
        "mesh: models are true surfaces; held_out: they are clouds, half of whose points are held out as the truth",
        choices=(MESH, HELD_OUT),
    )
    models: int = option(0, "number of models, evenly over their names; 0: all", minimum=0)
    points: int = option(
        40_000,
        "points of each input that has no number of its own, before any are removed; of a cloud, at most half",
        minimum=100,
    )
    vertices: tuple[int, ...] = option((5_000,), "numbers of vertices wanted, one or more")
    samples: int = option(EvaluationOptions().samples, "points drawn from each surface to evaluate a result", minimum=1)
    time_limit: float = option(600.0, "seconds after which a run is abandoned", minimum=0)
    pictures: int = option(4, "number of models that are drawn, evenly over their names", minimum=0)
    rendered: bool = option(False, "also compare renderings with those of the truth: PSNR and SSIM")
    seed: int = option(0, "seed of the points", minimum=0)
    normalization: str = option(
        LONGEST_SIDE.name,
        "unit of the tables; results.csv has both units",
        choices=tuple(each.name for each in NORMALIZATIONS),
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.vertices or any(type(each) is not int or each < 4 for each in self.vertices):
            raise UsageError(f"vertices is {self.vertices}.", "It is a list of whole numbers of at least 4.")
        if self.rendered and self.truth == HELD_OUT:
            raise UsageError(
                "A cloud cannot be rendered: it has no surface.", 'Leave out rendered or truth = "held_out".'
            )


@dataclass(frozen=True)
class SuiteInput:
    """How the points of a model are made: the kind of sample, the scan if it is one, and the degradation.

    The number of points is that of `scan` for every kind.
    """

    name: str
    sample: SampleOptions
    scan: ScanOptions
    degradation: DegradationOptions


@dataclass(frozen=True)
class SuiteMethod:
    """A method under a name of its own, with its options as written in the suite."""

    name: str
    method: str
    values: Mapping[str, Any]

    def options(self) -> Any:
        """Return the options; see ``method_options`` for the errors."""
        return method_options(self.method, self.values)


@dataclass(frozen=True)
class Quoted:
    """Scores published elsewhere, on other data: CD in 1e-5, HD in 1e-2, time in seconds."""

    name: str
    source: str
    vertices: float | None = None
    chamfer: float | None = None
    f1: float | None = None
    normal_consistency: float | None = None
    hausdorff: float | None = None
    g: float | None = None
    seconds: float | None = None


@dataclass(frozen=True)
class Suite:
    """The content of a suite."""

    name: str
    options: SuiteOptions
    inputs: tuple[SuiteInput, ...]
    methods: tuple[SuiteMethod, ...]
    quoted: tuple[Quoted, ...] = ()
    folder: Path = field(default_factory=Path)

    def __post_init__(self) -> None:
        for each in self.inputs:
            if self.options.truth == HELD_OUT and each.sample.kind != SampleOptions().kind:
                raise UsageError(
                    f"The input {each.name!r} is of kind {each.sample.kind!r}: a cloud has no surface for that.",
                    "Leave out kind: points of the cloud are taken at random.",
                )

    @property
    def meshes(self) -> str:
        """The folder of the models; empty if the suite names none."""
        return str(self.folder / self.options.meshes) if self.options.meshes else ""
