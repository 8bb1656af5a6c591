# SPDX-License-Identifier: GPL-3.0-or-later
"""The results as tables: every run in CSV, means by input and budget in Markdown."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from hdpea.benchmark.means import COLUMNS, TIME_TITLES, TIMES, Means, best_of
from hdpea.benchmark.record import Record
from hdpea.benchmark.suite import Quoted
from hdpea.runtime.outputs import replacing


def markdown_table(means: Sequence[Means]) -> str:
    """Return the rows as Markdown; the best of each column is bold."""
    titles, rows = cells_of(means)
    return _markdown(titles, [[f"**{text}**" if best else text for text, best in row] for row in rows])


def cells_of(means: Sequence[Means]) -> tuple[list[str], list[list[tuple[str, bool]]]]:
    """Return the titles, and each row's cells and whether they are the best; columns without values are left out."""
    best = best_of(means)
    shown = [i for i in range(len(COLUMNS)) if any(row.values[i] is not None for row in means)]
    rows = []
    for row in means:
        cells = [(row.method, False), (f"{row.finished}/{row.tried}", False)]
        cells += [(COLUMNS[i].text(row.values[i]), (row.method, i) in best) for i in shown]
        for (_, scale, digits), value in zip(TIMES, row.times, strict=True):
            cells.append(("" if value is None else f"{scale * value:.{digits}f}", False))
        rows.append(cells)
    return ["method", "models", *(COLUMNS[i].title for i in shown), *TIME_TITLES], rows


def quoted_cells(quoted: Sequence[Quoted]) -> tuple[list[str], list[list[str]]]:
    """Return the titles and the rows of the published numbers."""
    columns = [each for each in COLUMNS if each.quoted]
    rows = []
    for row in quoted:
        values = [*((getattr(row, column.quoted), column.digits) for column in columns), (row.seconds, 1)]
        cells = ["" if value is None else f"{value:,.{digits}f}" for value, digits in values]
        rows.append([f"{row.name} (quoted)", row.source, *cells])
    return ["method", "from", *(each.title for each in columns), "seconds"], rows


def quoted_table(quoted: Sequence[Quoted]) -> str:
    """Return the published numbers as Markdown."""
    titles, rows = quoted_cells(quoted)
    return _markdown(titles, rows)


def _markdown(titles: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [titles, ["---"] * len(titles), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def write_csv(path: Path, records: Sequence[Record]) -> None:
    """Write all scores of all runs in full precision, lengths unscaled, one column for each path to a score."""
    rows = [
        {
            "input": each.given,
            "model": each.model,
            "method": each.method,
            "vertices_wanted": each.vertices,
            "failed": each.failed,
            "seconds": each.seconds,
            "cpu_seconds": each.cpu_seconds,
            "peak_bytes": each.peak_bytes,
            **dict(_flat(each.scores)),
        }
        for each in records
    ]
    columns = list(dict.fromkeys(name for row in rows for name in row))
    with replacing(path) as partial, partial.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def _flat(scores: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in scores.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value
