# SPDX-License-Identifier: GPL-3.0-or-later
"""The report in the few lines that people read."""

from __future__ import annotations

from collections.abc import Iterator

from hdpea.options.choice import Choice
from hdpea.report.report import Distances, MeshFacts, Report


def summarize(report: Report) -> str:
    """Return what was chosen, what came out and what it took; a line each."""
    return "\n".join(_lines(report))


def _lines(report: Report) -> Iterator[str]:
    yield from map(describe, report.choices)
    yield from report.notes
    yield _mesh(report.mesh)
    yield _distances(report.distances)
    total = report.clock.total()
    yield f"took {total.seconds:.1f} s, at most {total.peak_bytes / 1e9:.2f} GB"


def describe(choice: Choice) -> str:
    """Return one automatic choice and its reason as a line."""
    value = f"{choice.value:.4g}" if isinstance(choice.value, float) else str(choice.value)
    return f"{choice.name}: {' '.join(filter(None, [value, choice.unit]))} ({choice.why})"


def _mesh(mesh: MeshFacts) -> str:
    facts = [
        _count(mesh.vertices, "vertex", "vertices"),
        _count(mesh.faces, "face", "faces"),
        "manifold" if mesh.manifold else "NOT manifold",
        "closed" if mesh.closed else _count(mesh.boundary_loops, "boundary loop", "boundary loops"),
        _count(mesh.components, "component", "components"),
    ]
    if mesh.genus is not None:
        facts.append(f"genus {mesh.genus}")
    if mesh.self_intersections:
        facts.append(_count(mesh.self_intersections, "self-intersection", "self-intersections"))
    return "mesh: " + ", ".join(facts)


def _count(number: int, one: str, many: str) -> str:
    return f"{number:,} {one if number == 1 else many}"


def _distances(distances: Distances) -> str:
    spacings = f" ({distances.rms / distances.spacing:.2g} spacings)" if distances.spacing > 0 else ""
    return (
        f"points to mesh: rms {distances.rms:.3g}{spacings}, "
        f"95% within {distances.percentile_95:.3g}, max {distances.max:.3g}"
    )
