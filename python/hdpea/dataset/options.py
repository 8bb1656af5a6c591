# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults of the ground truth: one dataclass per stage, as in ``hdpea.options``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from hdpea.options import Checked, option
from hdpea.options.embedding import BENDING_LENGTH

if TYPE_CHECKING:
    from hdpea.geometry.metric import ScaledMetric


@dataclass(frozen=True)
class GroundTruthOptions(Checked):
    """How the true embedding of a mesh is computed.

    Lengths are in spacings, sqrt(area / vertices): what a mesh of so many vertices can resolve depends on the area
    of the surface, not on the diagonal of its box. On the validation meshes the spacing of 5,000 vertices is from 0.8
    to 2.2 % of the diagonal.
    """

    vertices: int = option(5_000, "vertices of the meshes that the embedding is meant for", minimum=4)
    remesh_length: float = option(0.5, "edge length of the triangles it is solved on, in spacings", minimum=0)
    curvature_radius: float = option(1.2, "radius in which curvature is measured, in spacings", minimum=0)
    bending_length: float = option(BENDING_LENGTH, "length below which it does not bend, in spacings", minimum=0)
    metric_scale: float = option(40.0, "c of the metric s^2 = c |k|, in spacings: larger stretches more", minimum=0)
    max_stretch: float = option(6.0, "largest stretch of the metric in any direction", minimum=1)

    @property
    def metric(self) -> ScaledMetric:
        """The metric, in spacings."""
        from hdpea.geometry.metric import ScaledMetric

        return ScaledMetric(self.metric_scale, self.max_stretch, self.bending_length, self.curvature_radius)


@dataclass(frozen=True)
class SamplingOptions(Checked):
    """How points are drawn from a mesh."""

    points: int = option(40_000, "points to draw", minimum=1)
    method: str = option(
        "area", "area: uniform by area; farthest: each far from the others", choices=("area", "farthest")
    )
    seed: int = option(0, "seed of everything random; the same seed gives the same points", minimum=0)


@dataclass(frozen=True)
class DegradationOptions(Checked):
    """How a sample is degraded; 0 disables a degradation. Lengths are shares of the bounding-box diagonal."""

    clipped: bool = option(False, "keep only one side of a plane through the middle of the points")
    missing: int = option(0, "balls to cut out, around points of the surface", minimum=0)
    missing_radius: float = option(0.05, "radius of these balls", minimum=0)
    density: str = option(
        "even",
        "gradient: thinned out along the longest axis; striped: in stripes across it; fewer points remain",
        choices=("even", "gradient", "striped"),
    )
    noise: float = option(
        0.0, "std of Gaussian noise on each coordinate of the points (HD-PEA: 0.001 to 0.005)", minimum=0
    )
    outliers: float = option(0.0, "share of the points that are moved to random places", minimum=0, maximum=1)
    normal_noise: float = option(0.0, "std of Gaussian noise on the normals (HD-PEA: 0.001, 0.002)", minimum=0)
    flipped: float = option(0.0, "share of the normals that are reversed", minimum=0, maximum=1)
    seed: int = option(0, "seed of everything random; the same seed gives the same points", minimum=0)


@dataclass(frozen=True)
class ScanOptions(Checked):
    """How a mesh is scanned by a simulated range sensor, and with which faults: 0 disables a fault.

    Lengths are shares of the bounding-box diagonal of the mesh.
    """

    points: int = option(40_000, "points to return", minimum=1)
    sensor: str = option(
        "views",
        "views: a depth camera all around; turntable: a sensor above the horizon, the model rotating about z; "
        "lidar: at the sides, beams rotating about z, points dense along rings",
        choices=("views", "turntable", "lidar"),
    )
    views: int = option(12, "positions of the sensor", minimum=1)
    coverage: float = option(
        1.0, "share of all directions (turntable, lidar: of a turn) seen from", minimum=0.01, maximum=1
    )
    distance: float = option(1.5, "from the sensor to the middle of the model", minimum=0.6)
    ring_ratio: float = option(15.0, "times that points are denser along the rings of a lidar than across", minimum=1)
    noise: float = option(0.0005, "std of the range of a surface that faces the sensor, at that distance", minimum=0)
    noise_growth: str = option(
        "quadratic",
        "how that noise grows with the range: quadratic, as of depth cameras; linear; none",
        choices=("none", "linear", "quadratic"),
    )
    grazing: float = option(
        75.0, "degrees between ray and normal beyond which fewer and fewer rays return", minimum=0, maximum=90
    )
    flying: float = option(
        0.0, "share of the pixels at jumps in depth that are measured behind the surface", minimum=0, maximum=1
    )
    flying_length: float = option(0.05, "how far behind it they are measured at most", minimum=0)
    misrotated: float = option(
        0.0, "degrees by which each view is rotated about the middle of the model", minimum=0, maximum=180
    )
    misplaced: float = option(0.0, "length by which each view is shifted, root mean square", minimum=0)
    outliers: float = option(0.0, "share of the points that are moved to random places", minimum=0, maximum=1)
    step: float = option(0.0, "step of the coordinates, which are rounded to multiples of it", minimum=0)
    seed: int = option(0, "seed of everything random; the same seed gives the same points", minimum=0)


@dataclass(frozen=True)
class SampleOptions(Checked):
    """How the points of a sample are made, and what is added to them."""

    kind: str = option(
        "area",
        "area: points at random, even by area; farthest: each far from the others; scan: as sensors see the surface",
        choices=("area", "farthest", "scan"),
    )
    estimate: bool = option(False, "add normals estimated from the points alone, like those of scans")
    augmented: bool = option(False, "write all ten augmentations, for a release; otherwise they are applied on loading")


@dataclass(frozen=True)
class DatasetOptions(Checked):
    """All options of ``hdpea.dataset.build_dataset``; the manifest records all but those of the run."""

    sample: SampleOptions = SampleOptions()
    sampling: SamplingOptions = SamplingOptions()
    scanning: ScanOptions = ScanOptions()
    ground_truth: GroundTruthOptions = GroundTruthOptions()
    jobs: int = option(0, "meshes processed at a time, sharing the cores; 0: one per core", minimum=0)
    time_limit: float = option(3600, "seconds after which a mesh is abandoned and skipped", minimum=0)

    @property
    def source_of_points(self) -> str:
        """The stage that the points come from; the other one is unused."""
        return "scanning" if self.sample.kind == "scan" else "sampling"

    @property
    def seed(self) -> int:
        """The seed of that stage."""
        seed: int = getattr(self, self.source_of_points).seed
        return seed
