# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of a training: means of the loss and its terms, from metrics.jsonl.

    python benchmarks/training_curves.py FOLDER [--every 500]

FOLDER is the output of `hdpea train`. Prints Markdown.
"""

from __future__ import annotations

import json
from pathlib import Path

import click
from means_table import print_means

from hdpea.training.journal import METRICS

COLUMNS = {"loss": 3, "distance": 3, "metric": 3, "flatness": 3, "seconds_per_step": 2}


@click.command()
@click.argument("folder", type=click.Path(exists=True, path_type=Path))
@click.option("--every", default=500, show_default=True, help="steps in a row")
def main(*, folder: Path, every: int) -> None:
    """Print the means over intervals of steps."""
    lines = [json.loads(line) for line in (folder / METRICS).read_text().splitlines()]
    rows: dict[tuple[str, ...], list[list[float]]] = {}
    for line in lines:
        if "loss" in line:
            until = -(-line["step"] // every) * every
            rows.setdefault((f"{until:,}",), []).append([line[column] for column in COLUMNS])
    print_means(["steps to"], COLUMNS, rows)


if __name__ == "__main__":
    main()
