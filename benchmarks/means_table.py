# SPDX-License-Identifier: GPL-3.0-or-later
"""Means of measurements, as Markdown."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import click
import numpy as np


def print_means(
    head: Sequence[str], columns: Mapping[str, int], measured: Mapping[tuple[str, ...], Sequence[Sequence[float]]]
) -> None:
    """Print a row of means for each key of `measured`, after its words; `columns` gives the digits of each."""
    click.echo("| " + " | ".join([*head, *columns]) + " |\n|" + "---|" * (len(head) + len(columns)))
    for words, rows in measured.items():
        cells = (f"{value:.{digits}f}" for value, digits in zip(np.mean(rows, axis=0), columns.values(), strict=True))
        click.echo("| " + " | ".join([*words, *cells]) + " |")
