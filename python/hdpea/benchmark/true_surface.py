# SPDX-License-Identifier: GPL-3.0-or-later
"""Models whose surface is known: a closed mesh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from hdpea.benchmark.clouds import make_cloud
from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.model import Model
from hdpea.benchmark.rendering import compare_renderings
from hdpea.benchmark.scene import Scene, SurfaceScene
from hdpea.benchmark.suite import SuiteInput
from hdpea.dataset.surface_file import read_surface
from hdpea.evaluation.truth import Truth, truth_of_mesh
from hdpea.geometry.triangles import TriangleMesh


@dataclass
class TrueSurface(Model):
    """A true mesh, which is sampled or scanned."""

    @cached_property
    def surface(self) -> TriangleMesh:
        """The closed surface, in world units."""
        return read_surface(self.source.path)

    @cached_property
    def truth(self) -> Truth:
        """The surface, prepared for the evaluation of results."""
        return truth_of_mesh(*self.surface, self.measuring)

    def cloud(self, given: SuiteInput) -> Cloud:
        """Sample the surface, or scan it; with true normals unless the input asks for estimated ones."""
        return make_cloud(self.surface, self.name, given, self.options.seed)

    def scene(self) -> Scene:
        """Return the scene of the surface."""
        return SurfaceScene.of(self.surface)

    def scores(self, mesh: TriangleMesh) -> dict[str, Any]:
        """Return the scores of a result, including those of renderings if the suite asks for them."""
        scores = super().scores(mesh)
        if self.options.rendered:
            scores["rendering"] = compare_renderings(self.surface, mesh)
        return scores
