# SPDX-License-Identifier: GPL-3.0-or-later
"""A suite: which models, what is made of them, which methods, how many vertices; which ``suite_file`` reads."""

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
    """What a suite says about all its runs."""

    title: str = option("", "what it is, in a line")
    meshes: str = option("", "folder of the models, from where the suite lies; those that a run is given win over it")
    truth: str = option(
        MESH,
        "mesh: models are true surfaces; held_out: they are clouds, half of which no method is given and is the truth",
        choices=(MESH, HELD_OUT),
    )
    models: int = option(0, "how many of them, evenly over their names; 0: all", minimum=0)
    points: int = option(
        40_000,
        "points of each input that does not say otherwise, before any are taken away; of a cloud, at most half",
        minimum=100,
    )
    vertices: tuple[int, ...] = option((5_000,), "vertices wanted, one or several numbers")
    samples: int = option(EvaluationOptions().samples, "points drawn of each surface to measure a result", minimum=1)
    time_limit: float = option(600.0, "seconds after which a run is given up", minimum=0)
    pictures: int = option(4, "how many models are drawn, evenly over their names", minimum=0)
    rendered: bool = option(False, "compare pictures under one light with the truth's, too: PSNR and SSIM")
    seed: int = option(0, "seed of the points", minimum=0)
    normalization: str = option(
        LONGEST_SIDE.name,
        "unit of the tables; results.csv has both",
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
    """A way to make points of a model: the kind of the sample, the scan if it is one, and what is done to it then.

    The number of points is that of `scan`, whatever the kind.
    """

    name: str
    sample: SampleOptions
    scan: ScanOptions
    degradation: DegradationOptions


@dataclass(frozen=True)
class SuiteMethod:
    """A method under a name of its own, with its options as the suite has them."""

    name: str
    method: str
    values: Mapping[str, Any]

    def options(self) -> Any:
        """Return the options; see ``method_options`` for the errors."""
        return method_options(self.method, self.values)


@dataclass(frozen=True)
class Quoted:
    """Scores that somebody else published, on data of their own: CD in 1e-5, HD in 1e-2, time in seconds."""

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
    """Everything a suite says."""

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
        """Where the models are; empty if the suite does not say."""
        return str(self.folder / self.options.meshes) if self.options.meshes else ""
