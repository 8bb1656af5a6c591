# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean scores of the methods, by input and budget."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, log

from hdpea.benchmark.record import Record
from hdpea.benchmark.suite import Suite

FLOOR = "floor"
Point = tuple[float, float]


@dataclass(frozen=True)
class Column:
    """A column of the means: the path to its score, with {unit} for the normalisation, and its format.

    `better` is 1 if larger is better, -1 if smaller is, and 0 if neither. The column is empty for runs that have the
    score `unless`, which replaces it.
    """

    title: str
    path: str
    scale: float = 1.0
    digits: int = 3
    better: int = 0
    floor: str = ""
    quoted: str = ""
    unless: str = ""

    def of(self, record: Record, unit: str) -> float | None:
        """Return the score of a run; None if it has none, or has the one that replaces it."""
        if self.unless and record.score(self.unless.format(unit=unit)) is not None:
            return None
        return record.score(self.path.format(unit=unit))

    def text(self, value: float | None) -> str:
        """Return a value formatted for the table."""
        return "" if value is None else f"{self.scale * value:,.{self.digits}f}"


def _between_samples(title: str, name: str, scale: float, digits: int, better: int) -> Column:
    path = f"accuracy.{{unit}}.%s.{name}"
    return Column(title, path % "samples", scale, digits, better, path % "floor", name)


COLUMNS = (
    Column("vertices", "topology.vertices", digits=0, quoted="vertices"),
    Column("exact CD (1e-5)", "accuracy.{unit}.chamfer", 1e5, better=-1),
    Column("exact HD (1e-2)", "accuracy.{unit}.hausdorff", 1e2, better=-1),
    Column("exact rms (1e-2)", "accuracy.{unit}.to_result.rms", 1e2, better=-1, unless="accuracy.{unit}.chamfer"),
    Column("exact max (1e-2)", "accuracy.{unit}.to_result.max", 1e2, better=-1, unless="accuracy.{unit}.hausdorff"),
    Column("G", "triangles.g", better=1, quoted="g"),
    _between_samples("CD (1e-5)", "chamfer", 1e5, 3, -1),
    _between_samples("F1", "f1", 1, 4, 1),
    _between_samples("NC", "normal_consistency", 1, 4, 1),
    _between_samples("HD (1e-2)", "hausdorff", 1e2, 3, -1),
    Column("degenerate %", "triangles.degenerate", 100, 2, -1),
    Column("manifold", "topology.manifold", digits=2, better=1),
    Column("watertight", "topology.watertight", digits=2),
    Column("PSNR (dB)", "rendering.psnr", digits=2, better=1),
    Column("SSIM", "rendering.ssim", digits=4, better=1),
)
TIMES = (("seconds", 1.0, 1), ("cpu_seconds", 1.0, 1), ("peak_bytes", 1e-9, 2))
TIME_TITLES = ("seconds", "CPU seconds", "GB")


@dataclass(frozen=True)
class Means:
    """The mean scores of a method for one input and budget, over the models that every method finished.

    `values` follow ``COLUMNS``, `times` follow ``TIMES``; `finished` and `tried` count models.
    """

    method: str
    finished: int
    tried: int
    values: tuple[float | None, ...]
    times: tuple[float | None, ...]


def means_of(records: Sequence[Record], suite: Suite, given: str, vertices: int) -> list[Means]:
    """Return a row for each method, and the floor if it is known; methods that finished no model have no values."""
    here = [each for each in records if (each.given, each.vertices) == (given, vertices)]
    of_method = {
        method.name: {each.model: each for each in here if each.method == method.name} for method in suite.methods
    }
    done = _finished(here, suite)
    common = _common(done)
    unit = suite.options.normalization
    rows = []
    for name, runs in of_method.items():
        counted = [runs[model] for model in sorted(common & done[name])]
        values = tuple(_mean([column.of(each, unit) for each in counted]) for column in COLUMNS)
        times = tuple(_mean([getattr(each, field) for each in counted]) for field, _, _ in TIMES)
        rows.append(Means(name, len(done[name]), len(runs), values, times))
    # All records of a model have the same floor.
    finished = list({each.model: each for each in here if each.model in common and not each.failed}.values())
    floors = tuple(
        _mean([each.score(column.floor.format(unit=unit)) for each in finished]) if column.floor else None
        for column in COLUMNS
    )
    floor = Means(FLOOR, len(common), len(common), floors, (None,) * len(TIMES))
    return [*rows, floor] if any(value is not None for value in floors) else rows


def error_by_size(records: Sequence[Record], suite: Suite, given: str, column: Column) -> dict[str, list[Point]]:
    """Return, for each method, the mean number of vertices and the geometric mean of an error, by wanted size.

    Over the models that every method finished at that size. Errors of models differ by orders of magnitude, so an
    arithmetic mean would show the worst model alone.
    """
    curves: dict[str, list[Point]] = {method.name: [] for method in suite.methods}
    for vertices in suite.options.vertices:
        here = [each for each in records if (each.given, each.vertices) == (given, vertices)]
        common = _common(_finished(here, suite))
        for name, curve in curves.items():
            counted = [each for each in here if each.method == name and each.model in common and not each.failed]
            errors = [column.of(each, suite.options.normalization) for each in counted]
            size = _mean([each.score("topology.vertices") for each in counted])
            if size and all(errors):
                logarithm = _mean([log(error) for error in errors if error])
                curve.append((size, column.scale * exp(logarithm or 0.0)))
    return curves


def _finished(records: Sequence[Record], suite: Suite) -> dict[str, set[str]]:
    """Return the models that each method finished."""
    return {
        method.name: {each.model for each in records if each.method == method.name and not each.failed}
        for method in suite.methods
    }


def _common(finished: dict[str, set[str]]) -> set[str]:
    """Return the models finished by all methods, ignoring methods that finished none."""
    return set.intersection(*[models for models in finished.values() if models] or [set()])


def _mean(values: Sequence[float | None]) -> float | None:
    known = [each for each in values if each is not None]
    return sum(known) / len(known) if known else None


def best_of(means: Sequence[Means]) -> set[tuple[str, int]]:
    """Return the methods and columns of the best values after rounding; none where all values are equal."""
    best = set()
    methods = [row for row in means if row.method != FLOOR]
    for i, column in enumerate(COLUMNS):
        known = [row for row in methods if row.values[i] is not None]
        texts = {row.method: column.text(row.values[i]) for row in known}
        if column.better and len(set(texts.values())) > 1:
            winner = max(known, key=lambda row: column.better * (row.values[i] or 0.0))
            best |= {(name, i) for name, text in texts.items() if text == texts[winner.method]}
    return best
