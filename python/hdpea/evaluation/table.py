# SPDX-License-Identifier: GPL-3.0-or-later
"""An evaluation as a table of text."""

from __future__ import annotations

from collections.abc import Iterator

from hdpea.evaluation.normalization import NORMALIZATIONS
from hdpea.evaluation.scores import DEGENERATE_ANGLE, Accuracy, Evaluation, SampleScores, Topology, TriangleScores

NAME_WIDTH, VALUE_WIDTH = 34, 18
UNKNOWN = "-"


def describe(evaluation: Evaluation) -> str:
    """Return all scores as a table: topology, distances in both normalisations side by side, triangle shapes."""
    return "\n".join(_lines(evaluation))


def _lines(evaluation: Evaluation) -> Iterator[str]:
    yield _topology(evaluation.topology)
    yield ""
    yield _row("", *(each.title for each in NORMALIZATIONS))
    both = [evaluation.accuracy[each.name] for each in NORMALIZATIONS]
    thresholds = " / ".join(f"{each.f1_threshold:g}" for each in NORMALIZATIONS)
    yield _samples(evaluation)
    yield from _between_samples(both, thresholds)
    yield "exact, to the surface"
    yield from _exact(both)
    yield ""
    yield from _triangles(evaluation.triangles)
    yield from evaluation.notes


def _samples(evaluation: Evaluation) -> str:
    count = f"{evaluation.options.samples:,}"
    if evaluation.truth == "points":
        return f"between {count} samples of the result and the {evaluation.truth_points:,} points of the truth"
    return f"between {count} samples of each (in brackets the floor)"


def _topology(topology: Topology) -> str:
    facts = [
        _count(topology.vertices, "vertex", "vertices"),
        _count(topology.faces, "face", "faces"),
        "manifold" if topology.manifold else _defects(topology),
        "watertight" if topology.watertight else _count(topology.boundary_edges, "boundary edge", "boundary edges"),
        _count(topology.components, "component", "components"),
        _count(topology.self_intersections, "self-intersection", "self-intersections"),
    ]
    facts += [] if topology.oriented else ["NOT of one orientation"]
    return ", ".join(facts + ([] if topology.genus is None else [f"genus {topology.genus}"]))


def _defects(topology: Topology) -> str:
    edges = _count(topology.nonmanifold_edges, "edge", "edges")
    return f"NOT manifold ({edges}, {_count(topology.nonmanifold_vertices, 'vertex', 'vertices')})"


def _between_samples(both: list[Accuracy], thresholds: str) -> Iterator[str]:
    def values(name: str, scale: float, digits: int) -> Iterator[str]:
        for each in both:
            yield _floored(each.samples, each.floor, name, scale, digits)

    yield _row("  CD, chamfer distance (1e-5)", *values("chamfer", 1e5, 3))
    yield _row(f"  F1 within {thresholds}", *values("f1", 1, 4))
    yield _row("  NC, normal consistency", *values("normal_consistency", 1, 4))
    yield _row("  HD, Hausdorff distance (1e-2)", *values("hausdorff", 1e2, 3))


def _floored(scores: SampleScores, floor: SampleScores | None, name: str, scale: float, digits: int) -> str:
    value = _number(getattr(scores, name), scale, digits)
    return value if floor is None else f"{value} ({_number(getattr(floor, name), scale, digits)})"


def _exact(both: list[Accuracy]) -> Iterator[str]:
    yield _row("  CD (1e-5)", *(_number(each.chamfer, 1e5, 3) for each in both))
    yield _row("  HD (1e-2)", *(_number(each.hausdorff, 1e2, 3) for each in both))
    for direction, name in (("truth to result", "to_result"), ("result to truth", "to_truth")):
        for kind in ("rms", "max"):
            values = (getattr(getattr(each, name), kind, None) for each in both)
            yield _row(f"  {direction}, {kind} (1e-2)", *(_number(value, 1e2, 4) for value in values))


def _triangles(triangles: TriangleScores) -> Iterator[str]:
    yield _row("G, under the truth's curvature", _number(triangles.g, 1, 3))
    yield _row("G in space", _number(triangles.g_isotropic, 1, 3))
    yield _row(f"with an angle below {DEGENERATE_ANGLE:g} degree", f"{triangles.degenerate:.2%}")
    yield _row("smallest angle", f"{triangles.smallest_angle:.2f} degrees")
    yield _row("smallest angle, mean", f"{triangles.mean_smallest_angle:.2f} degrees")
    yield _row("largest angle", f"{triangles.largest_angle:.2f} degrees")


def _number(value: float | None, scale: float, digits: int) -> str:
    return UNKNOWN if value is None else f"{scale * value:.{digits}f}"


def _count(number: int, one: str, many: str) -> str:
    return f"{number:,} {one if number == 1 else many}"


def _row(name: str, *values: str) -> str:
    return f"{name:<{NAME_WIDTH}}" + "".join(f"{value:>{VALUE_WIDTH}}" for value in values)
