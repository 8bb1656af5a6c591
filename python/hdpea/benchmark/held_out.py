# SPDX-License-Identifier: GPL-3.0-or-later
"""Models of which only a cloud is known, such as real scans: points held out from all methods are the truth."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hdpea.benchmark.clouds import bare_sample, cloud_of
from hdpea.benchmark.methods import Cloud
from hdpea.benchmark.model import Model
from hdpea.benchmark.scene import PointScene, Scene
from hdpea.benchmark.suite import HELD_OUT, SuiteInput
from hdpea.dataset.build import seed_of
from hdpea.dataset.degradation import degraded
from hdpea.dataset.options import DegradationOptions
from hdpea.errors import CannotReconstruct
from hdpea.evaluation.truth import Truth, truth_of_points
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.reading import PointCloud, read_points
from hdpea.surface.normals import oriented_surface


@dataclass
class HeldOut(Model):
    """A cloud in two halves: one provides the inputs, the other is the truth."""

    @property
    def content(self) -> str:
        """As for any model, but different from that of the same file taken as a surface."""
        return f"{HELD_OUT} of {self.source.sha256()}"

    @cached_property
    def halves(self) -> tuple[PointCloud, PointCloud]:
        """Points for the inputs, in random order, and points held out."""
        return halves_of(read_points(self.source.path), seed_of(self.name, self.options.seed))

    @cached_property
    def truth(self) -> Truth:
        """The points held out, with the normals of the file, if any."""
        _, held_out = self.halves
        return truth_of_points(held_out.points, held_out.normals, self.measuring)

    def cloud(self, given: SuiteInput) -> Cloud:
        """Take the first points of those for the inputs: as many as the input asks for, or all."""
        to_give, _ = self.halves
        return make_cloud_of_points(to_give, self.name, given, self.options.seed)

    def scene(self) -> Scene:
        """Return the scene of the points held out."""
        _, held_out = self.halves
        return PointScene.of(held_out.points, held_out.normals)


def halves_of(cloud: PointCloud, seed: int) -> tuple[PointCloud, PointCloud]:
    """Split a cloud at random into two halves, each in random order; of an odd number, the second has one more.

    Raises
    ------
    CannotReconstruct
        If there are fewer than two points.
    """
    if len(cloud.points) < 2:
        raise CannotReconstruct("The cloud is a single point.", "Half of its points are held out, as the truth.")
    rows = np.random.default_rng(seed).permutation(len(cloud.points))
    half = len(rows) // 2
    return cloud.at(rows[:half]), cloud.at(rows[half:])


def make_cloud_of_points(to_give: PointCloud, model: str, given: SuiteInput, seed: int) -> Cloud:
    """Take the first points of a cloud in world units, and degrade them; the same for the same names and seed.

    Normals are those of the file where they are usable, unless the input asks for estimated ones; the others are
    estimated from the degraded points, and all are oriented as ``hdpea.surface.normals`` does by default.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    UsageError
        If no points remain.
    """
    seed = seed_of(model, seed)
    frame = UnitFrame.around(to_give.points)  # of all points, so that noise does not depend on how many are taken
    taken = to_give.at(np.arange(min(given.scan.points, len(to_give.points))))
    points = frame.to_unit(taken.points)
    from_file = np.zeros_like(points) if taken.normals is None else taken.normals
    asked = replace(given.degradation, seed=seed)
    worse = degraded(bare_sample(points, points, from_file, frame), asked)
    known = None if given.sample.estimate else worse.normals.astype(np.float64)
    oriented = oriented_surface(worse.points.astype(np.float64), known).surface.normals
    # Normals are degraded last: orienting them would undo flips.
    of_normals = DegradationOptions(normal_noise=asked.normal_noise, flipped=asked.flipped, seed=seed)
    worse = degraded(replace(worse, estimated_normals=oriented.astype(np.float32)), of_normals)
    return cloud_of(worse, model, given)
