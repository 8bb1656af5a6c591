# SPDX-License-Identifier: GPL-3.0-or-later
"""All that is measured of a result."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from hdpea.evaluation.distances import OneWay
from hdpea.evaluation.normalization import NORMALIZATIONS
from hdpea.evaluation.options import EvaluationOptions
from hdpea.version import version

DEGENERATE_ANGLE = 1.0
"""Degrees; a triangle with a smaller angle counts as degenerate."""


@dataclass(frozen=True)
class SampleScores:
    """Scores between samples, as papers report them, in one unit of length.

    ``chamfer`` is in squares of the unit, ``hausdorff`` in the unit; ``normal_consistency`` is None where normals are
    unknown.
    """

    chamfer: float
    f1: float
    normal_consistency: float | None
    hausdorff: float


@dataclass(frozen=True)
class Accuracy:
    """How far the result is from the truth, in one unit of length.

    Attributes
    ----------
    samples
        Between samples of both.
    floor
        The same of the truth against itself; None if it is only points.
    to_result
        From the truth to the result, exact.
    to_truth
        From the result to the truth, exact; None if that is only points.
    chamfer, hausdorff
        As in `samples`, exact; None if the truth is only points.
    """

    samples: SampleScores
    floor: SampleScores | None
    to_result: OneWay
    to_truth: OneWay | None

    @property
    def chamfer(self) -> float | None:
        """Exact mean squared distance one way plus that the other way."""
        return None if self.to_truth is None else self.to_result.rms**2 + self.to_truth.rms**2

    @property
    def hausdorff(self) -> float | None:
        """Exact largest distance of either way."""
        return None if self.to_truth is None else max(self.to_result.max, self.to_truth.max)


@dataclass(frozen=True)
class TriangleScores:
    """Shapes of the triangles; angles in degrees.

    Attributes
    ----------
    g
        Mean quality under the curvature metric of the truth, 1 if all are equilateral there; None if the metric is
        not known.
    g_isotropic
        Mean quality in space, where anisotropic triangles are meant to be bad.
    degenerate
        Share of the triangles with an angle below ``DEGENERATE_ANGLE``.
    smallest_angle, mean_smallest_angle, largest_angle
        Of all triangles; the mean of each one's smallest; of all.
    """

    g: float | None
    g_isotropic: float
    degenerate: float
    smallest_angle: float
    mean_smallest_angle: float
    largest_angle: float


@dataclass(frozen=True)
class Topology:
    """What kind of surface the result is; `watertight`: every edge has exactly two faces."""

    vertices: int
    faces: int
    components: int
    boundary_edges: int
    boundary_loops: int
    nonmanifold_edges: int
    nonmanifold_vertices: int
    self_intersections: int
    manifold: bool
    oriented: bool
    watertight: bool
    genus: int | None


@dataclass(frozen=True)
class Evaluation:
    """Everything about one result.

    Attributes
    ----------
    topology, triangles
        Of the result.
    accuracy, units
        By name of the normalisation; the units in world units.
    truth
        ``mesh`` or ``points``.
    truth_points
        How many points stand for the truth.
    options
        How the surfaces were sampled.
    notes
        Sentences on what is odd about the pair.
    """

    topology: Topology
    triangles: TriangleScores
    accuracy: dict[str, Accuracy]
    units: dict[str, float]
    truth: str
    truth_points: int
    options: EvaluationOptions
    notes: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """Return all of it, fit for JSON; lengths as shares of the unit, and that unit in world units."""
        accuracy = {
            each.name: {
                "unit": self.units[each.name],
                "f1_threshold": each.f1_threshold,
                **asdict(self.accuracy[each.name]),
                "chamfer": self.accuracy[each.name].chamfer,
                "hausdorff": self.accuracy[each.name].hausdorff,
            }
            for each in NORMALIZATIONS
        }
        return {
            "version": version(),
            "options": asdict(self.options),
            "truth": self.truth,
            "truth_points": self.truth_points,
            "topology": asdict(self.topology),
            "triangles": asdict(self.triangles),
            "accuracy": accuracy,
            "notes": list(self.notes),
        }
