# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of results: results.csv, results.md, and index.html, which contains everything."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from hdpea.benchmark.curves import draw_curves
from hdpea.benchmark.gallery import Gallery
from hdpea.benchmark.means import COLUMNS, error_by_size, means_of
from hdpea.benchmark.page import write_page
from hdpea.benchmark.provenance import provenance
from hdpea.benchmark.record import Record
from hdpea.benchmark.suite import HELD_OUT, Suite
from hdpea.benchmark.tables import markdown_table, quoted_table, write_csv
from hdpea.benchmark.winners import winner_sentences
from hdpea.evaluation.normalization import NORMALIZATIONS
from hdpea.runtime.outputs import replacing

MEANS = "Means over the models that every method finished; the best of each column is bold."

OF_POINTS = (
    "The truth is half of the points of each cloud, which no method was given; their noise counts as error of the "
    "mesh. Exact rms and max go from them to the mesh and not back, so they do not see surface where no points are; "
    "CD, F1 and HD do. NC is over the clouds that came with normals."
)

CURVE_COLUMNS = ("exact CD (1e-5)", "exact HD (1e-2)", "exact rms (1e-2)", "exact max (1e-2)")
"""Errors that are plotted against the number of vertices."""


def write_results(folder: Path, suite: Suite, records: Sequence[Record], gallery: Gallery) -> None:
    """Write the tables, the curves (``curves-*.svg``) and the page, each whole or not at all.

    Raises
    ------
    UsageError
        If they cannot be written.
    """
    write_csv(folder / "results.csv", records)
    curves = curves_of(suite, records)
    for name, svg in curves.items():
        with replacing(folder / f"{name}.svg") as partial:
            partial.write_text(svg)
    with replacing(folder / "results.md") as partial:
        partial.write_text(results_in_markdown(suite, records, curves))
    subtitle = [provenance(each.code for each in records) + ".", models_sentence(records), unit_sentence(suite)]
    subtitle += [MEANS, *truth_sentences(suite)]
    write_page(folder / "index.html", suite, records, gallery, curves, subtitle)


def models_sentence(records: Sequence[Record]) -> str:
    """Return a sentence that names the models."""
    models = list(dict.fromkeys(each.model for each in records))
    return f"Models ({len(models)}): {', '.join(models)}."


def unit_sentence(suite: Suite) -> str:
    """Return a sentence about the unit of lengths."""
    unit = next(each for each in NORMALIZATIONS if each.name == suite.options.normalization)
    box = "the box of the truth" if suite.options.truth == HELD_OUT else "the true surface's box"
    return f"Lengths: {unit.title} of {box}; F1 within {unit.f1_threshold:g}."


def truth_sentences(suite: Suite) -> list[str]:
    """Return remarks on the truth: none unless it is a point cloud."""
    return [OF_POINTS] if suite.options.truth == HELD_OUT else []


def results_in_markdown(suite: Suite, records: Sequence[Record], curves: dict[str, str]) -> str:
    """Return the whole of results.md."""
    parts = [
        f"# {suite.options.title or suite.name}",
        f"{provenance(each.code for each in records)}. {models_sentence(records)}",
        f"{unit_sentence(suite)} {MEANS}",
        *truth_sentences(suite),
    ]
    for given in suite.inputs:
        for vertices in suite.options.vertices:
            parts.append(f"## {given.name}, {vertices:,} vertices")
            parts.append(markdown_table(means_of(records, suite, given.name, vertices)))
            parts.append(winner_sentences(records, suite, given.name, vertices))
    parts += [f"![{name}]({name}.svg)" for name in curves]
    if suite.quoted:
        parts += ["## Published elsewhere, on other data", quoted_table(suite.quoted)]
    failures = [f"- {each.stem.as_posix()}: {each.failed}" for each in records if each.failed]
    if failures:
        parts += ["## Failures", "\n".join(failures)]
    return "\n\n".join(filter(None, parts)) + "\n"


def curves_of(suite: Suite, records: Sequence[Record]) -> dict[str, str]:
    """Return plots of the errors against the vertices, as SVG by file name; none for a single budget."""
    if len(suite.options.vertices) < 2:
        return {}
    drawn = {}
    for number, given in enumerate(suite.inputs, start=1):
        for title in CURVE_COLUMNS:
            column = next(each for each in COLUMNS if each.title == title)
            curves = error_by_size(records, suite, given.name, column)
            if any(curves.values()):
                kind = title.split()[1].lower()
                drawn[f"curves-{number}-{kind}"] = draw_curves(
                    f"{title} against size, geometric means: {given.name}", title, curves
                )
    return drawn
