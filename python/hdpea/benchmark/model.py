# SPDX-License-Identifier: GPL-3.0-or-later
"""The interface of a model of a suite, whether its surface is known or only points of it."""

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
from hdpea.geometry.triangles import TriangleMesh


@dataclass
class Model(ABC):
    """A model of a suite with these options; its file is read when a run first needs it, and only once."""

    source: Source
    options: SuiteOptions

    @property
    def name(self) -> str:
        """Its name in the suite."""
        return self.source.name

    @property
    def content(self) -> str | None:
        """A key that identifies the file's content and its use; None if the file cannot be read."""
        return self.source.sha256()

    @property
    def measuring(self) -> EvaluationOptions:
        """The options of the evaluation of results."""
        return EvaluationOptions(samples=self.options.samples)

    @cached_property
    @abstractmethod
    def truth(self) -> Truth:
        """The truth against which results are evaluated."""

    @abstractmethod
    def cloud(self, given: SuiteInput) -> Cloud:
        """Make the points of an input, in world units; the same for the same names and seed.

        Raises
        ------
        UnreadableInput
            If the file cannot be read.
        CannotReconstruct
            If no points can be made from it, or no normals of them.
        UsageError
            If a scan is requested and embreex is missing; if no points remain.
        """

    @abstractmethod
    def scene(self) -> Scene:
        """Return the scene in which truth and results are drawn; call ``check_drawing`` first."""

    def scores(self, mesh: TriangleMesh) -> dict[str, Any]:
        """Return the scores of a result, as ``Evaluation.as_dict`` does.

        Raises
        ------
        CannotReconstruct
            If it has no area.
        """
        return evaluate(*mesh, self.truth).as_dict()
