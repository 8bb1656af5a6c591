# SPDX-License-Identifier: GPL-3.0-or-later
"""What a model of a suite can do, whether its surface is known or only points of it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.scene import Scene
from hdpea.benchmark.suite import SuiteInput, SuiteOptions
from hdpea.dataset.sources import Source
from hdpea.evaluation.evaluation import evaluate
from hdpea.evaluation.options import EvaluationOptions
from hdpea.evaluation.truth import Truth
from hdpea.reading.triangle_mesh import TriangleMesh


@dataclass
class Model(ABC):
    """A model of a suite with these options; its file is read only if a run needs it, then once for all of them."""

    source: Source
    options: SuiteOptions

    @property
    def name(self) -> str:
        """Its name in the suite."""
        return self.source.name

    @property
    def content(self) -> str | None:
        """What tells its points and its truth from those of another file; None if the file cannot be read."""
        return self.source.sha256()

    @property
    def measuring(self) -> EvaluationOptions:
        """How results are measured."""
        return EvaluationOptions(samples=self.options.samples)

    @cached_property
    @abstractmethod
    def truth(self) -> Truth:
        """What results are measured against."""

    @abstractmethod
    def cloud(self, given: SuiteInput) -> Cloud:
        """Make the points of an input, in world units; the same for the same names and seed.

        Raises
        ------
        UnreadableInput
            If the file cannot be read.
        CannotReconstruct
            If no points can be had of it, or no normals of them.
        UsageError
            If a scan is asked for and embreex is missing; if no points are left.
        """

    @abstractmethod
    def scene(self) -> Scene:
        """Return the truth, to be drawn; ``check_drawing`` first."""

    def scores(self, mesh: TriangleMesh) -> dict[str, Any]:
        """Measure a result, as ``Evaluation.as_dict``.

        Raises
        ------
        CannotReconstruct
            If it has no area.
        """
        return evaluate(*mesh, self.truth).as_dict()
