# SPDX-License-Identifier: GPL-3.0-or-later
"""The report in the few lines that people read."""

from __future__ import annotations

from collections.abc import Iterator

from hdpea.options.choice import Choice
from hdpea.report.achieved_error import AchievedError
from hdpea.report.facts import Distances, HeightDifferences, MeshFacts
from hdpea.report.report import Report

MUCH_FILLED = 0.005
"""Share of the area from which on it is said that holes were filled: less is what cells leave open between points."""


def summarize(report: Report, where: str, verbose: bool = False) -> str:
    """Return what came out, how good it is and `where` it is: three lines, after what is unusual, a line each.

    If `verbose`, what was chosen, and why, comes before.
    """
    total = report.clock.total()
    chosen = map(describe, report.choices) if verbose else ()
    took = f"{where}: written after {total.seconds:.1f} s, with at most {total.peak_bytes / 1e9:.2f} GB of memory"
    return "\n".join([*chosen, *report.notes, *outcome(report), took])


def outcome(report: Report) -> Iterator[str]:
    """Yield what came out, and how good it is; a line each."""
    yield _mesh(report.mesh) + _filled(report.meshing.get("area_filled", 0))
    error = _error(report.error, bool(report.levels))
    yield _distances(report.distances) + _along_z(report.along_z) + error + _moved(report.error)
    for number, level in enumerate(report.levels, start=1):
        size = f"{level.vertices:,} vertices, {level.faces:,} faces"
        yield f"level {number}: {size}, rms {level.rms:.3g}, error {level.error:.3g}"


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


def _filled(share: float) -> str:
    return f"; {share:.1%} of the area fills holes, where there are no points" if share > MUCH_FILLED else ""


def _count(number: int, one: str, many: str) -> str:
    return f"{number:,} {one if number == 1 else many}"


def _distances(distances: Distances) -> str:
    spacings = f" ({distances.rms / distances.spacing:.2g} spacings)" if distances.spacing > 0 else ""
    return (
        f"points to mesh: rms {distances.rms:.3g}{spacings}, "
        f"95% within {distances.percentile_95:.3g}, max {distances.max:.3g}"
    )


def _along_z(differences: HeightDifferences | None) -> str:
    if differences is None:
        return ""
    others = f" ({_count(differences.others, 'point', 'points')} beside it)" if differences.others else ""
    return f"; along z: rms {differences.rms:.3g}, max {differences.max:.3g}{others}"


def _error(error: AchievedError, compared: bool) -> str:
    """Return the error to be compared with what was asked for, or with that of levels; without either, nothing."""
    if error.asked is None and not compared:
        return ""
    asked = "" if error.asked is None else f" of {error.asked:.3g} asked for"
    return f"; error, both ways: {error.larger:.3g}{asked}"


def _moved(error: AchievedError) -> str:
    """Return by how much points may be farther off than the error says; denoising softens edges, too."""
    return f"; points were denoised, by up to {error.moved_by_denoising:.3g}" if error.moved_by_denoising else ""
