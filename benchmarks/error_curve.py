# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw what error_table.py printed: triangles against error, `--error` beside Poisson and quadric collapse.

    python benchmarks/error_table.py FOLDER > table.md
    python benchmarks/error_curve.py table.md docs/error.svg

Geometric means over the models on which Poisson reaches each of the errors: without the others, on which it never does.
"""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import click
import numpy as np

from hdpea.benchmark.curves import draw_curves

NEVER = "never"


class Row(NamedTuple):
    """A row of the table: a model and an error in percent; its root mean square distance, and triangles of both."""

    model: str
    percent: float
    rms: float
    ours: int
    rival: str


def rows_of(table: str) -> list[Row]:
    """Return the rows of the table in a text."""
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]
    found = [each for each in cells if len(each) == 9 and each[-2].isdecimal()]
    return [Row(each[0], float(each[1]), float(each[6]) * float(each[1]), int(each[7]), each[8]) for each in found]


def curves_of(rows: list[Row]) -> tuple[int, dict[str, list[tuple[float, float]]]]:
    """Return how many models count, and the curves: triangles and error."""
    beyond = {row.model for row in rows if row.rival == NEVER}
    kept = [row for row in rows if row.model not in beyond]
    by_error = defaultdict(list)
    for row in kept:
        by_error[row.percent].append((row.ours, int(row.rival), row.rms))
    means = [np.exp(np.log(of_models).mean(axis=0)) for of_models in by_error.values()]
    curves = {
        "hdpea --error": [(float(ours), float(rms)) for ours, _, rms in means],
        "Poisson + collapse": [(float(rival), float(rms)) for _, rival, rms in means],
    }
    return len({row.model for row in kept}), curves


@click.command()
@click.argument("table", type=click.Path(exists=True, path_type=Path))
@click.argument("picture", type=click.Path(path_type=Path))
def main(table: Path, picture: Path) -> None:
    """Draw the curves of TABLE as PICTURE, an SVG file."""
    models, curves = curves_of(rows_of(table.read_text()))
    title = f"Root mean square distance to the truth, {models} models"
    picture.write_text(draw_curves(title, "in percent of the diagonal", curves, "triangles"))
    for name, curve in curves.items():
        click.echo(f"{name}: " + ", ".join(f"{size:.0f} triangles at {error:.2f} %" for size, error in curve))


if __name__ == "__main__":
    main()
