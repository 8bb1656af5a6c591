# SPDX-License-Identifier: GPL-3.0-or-later
"""The scores of a result, as they are reported; ``distances`` and ``triangle_shapes`` compute them."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from hdpea.evaluation.distances import DirectedDistances
from hdpea.evaluation.normalization import NORMALIZATIONS
from hdpea.evaluation.options import EvaluationOptions
from hdpea.version import version

DEGENERATE_ANGLE = 1.0
"""Degrees; a triangle with a smaller angle counts as degenerate."""


@dataclass(frozen=True)
class SampleScores:
    """Scores between samples, as papers report them, in one unit of length.

    ``chamfer`` is in the unit squared, ``hausdorff`` in the unit; ``normal_consistency`` is None where normals are
    unknown.
    """

    chamfer: float
    f1: float
    normal_consistency: float | None
    hausdorff: float


@dataclass(frozen=True)
class Accuracy:
    """Distances between the result and the truth, in one unit of length.

    Attributes
    ----------
    samples
        Between samples of both.
    floor
        The same between two samplings of the truth; None if the truth is a point cloud.
    to_result
        Exact distances from the truth to the result.
    to_truth
        Exact distances from the result to the truth; None if the truth is a point cloud.
    chamfer, hausdorff
        As in `samples`, but from the exact distances; None if the truth is a point cloud.
    """

    samples: SampleScores
    floor: SampleScores | None
    to_result: DirectedDistances
    to_truth: DirectedDistances | None

    @property
    def chamfer(self) -> float | None:
        """Sum of the exact mean squared distances in both directions."""
        return None if self.to_truth is None else self.to_result.rms**2 + self.to_truth.rms**2

    @property
    def hausdorff(self) -> float | None:
        """Largest exact distance in either direction."""
        return None if self.to_truth is None else max(self.to_result.max, self.to_truth.max)


@dataclass(frozen=True)
class TriangleScores:
    """Shapes of the triangles; angles in degrees.

    Attributes
    ----------
    g
        Mean quality under the curvature metric of the truth, 1 if all triangles are equilateral under it; None if the
        metric is unknown.
    g_isotropic
        Mean quality in Euclidean space, which is low by design for anisotropic triangles.
    degenerate
        Share of the triangles with an angle below ``DEGENERATE_ANGLE``.
    smallest_angle, mean_smallest_angle, largest_angle
        Smallest angle of all triangles; mean of the smallest angle of each triangle; largest angle of all.
    """

    g: float | None
    g_isotropic: float
    degenerate: float
    smallest_angle: float
    mean_smallest_angle: float
    largest_angle: float


@dataclass(frozen=True)
class Topology:
    """Combinatorial properties of the result; it is `watertight` if every edge has exactly two faces."""

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
    """All scores of one result.

    Attributes
    ----------
    topology, triangles
        Of the result.
    accuracy, units
        Distances by the name of the normalisation, and the length of each unit in world units.
    truth
        ``mesh`` or ``points``.
    truth_points
        Number of points that represent the truth.
    options
        How the surfaces were sampled.
    notes
        Warnings, as sentences.
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
        """Return all scores as a dictionary for JSON; lengths are in the unit, which is given in world units."""
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
