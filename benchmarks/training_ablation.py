# SPDX-License-Identifier: GPL-3.0-or-later
"""What the network is best trained for: each loss with the same number of steps, judged by reconstructions.

    python benchmarks/training_ablation.py TRAINING VALIDATION OUT [--steps 1500] [--stem]

TRAINING and VALIDATION are folders that `hdpea dataset build` made. Each loss trains a network of its own in a folder
of OUT, so a run that was stopped goes on where it was; then the clouds of VALIDATION are reconstructed from what each
has learned. The paper's are ndhde-* and point-* (its Table 4). Prints Markdown.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import click

from hdpea.dataset.loading import Dataset
from hdpea.network.options import CONFIGURATIONS
from hdpea.training.loop import train
from hdpea.training.options import LOSSES, PRESETS, LossOptions
from hdpea.training.validation import validate

COLUMNS = {"t3": "T3", "g": "G", "boundary": "boundary edges"}


@click.command()
@click.argument("training", type=click.Path(exists=True, path_type=Path))
@click.argument("validation", type=click.Path(exists=True, path_type=Path))
@click.argument("out", type=click.Path(file_okay=False, path_type=Path))
@click.option("--steps", default=1500, show_default=True)
@click.option("--stem", is_flag=True, help="compare ways to see curvature instead of losses")
def main(*, training: Path, validation: Path, out: Path, steps: int, stem: bool) -> None:
    """Train once for each row, and reconstruct the clouds of VALIDATION."""
    compact, preset = CONFIGURATIONS["compact"], replace(PRESETS["cpu"], steps=steps)
    if stem:
        rows = {
            "shape operator": (compact, preset),
            "edge convolutions": (replace(compact, shape=False, stem=True), preset),
            "both": (replace(compact, stem=True), preset),
            "neither": (replace(compact, shape=False), preset),
        }
    else:
        rows = {loss: (compact, replace(preset, loss=LossOptions(loss=loss))) for loss in LOSSES}
    samples, judged = Dataset(training), Dataset(validation)
    click.echo(f"{steps} steps each on {len(samples)} clouds; means over {len(judged)} others\n")
    click.echo("| trained with | " + " | ".join(COLUMNS.values()) + " |\n" + "|---" * (1 + len(COLUMNS)) + "|")
    for name, (network, options) in rows.items():
        folder = out / name.replace(" ", "_")
        folder.mkdir(parents=True, exist_ok=True)
        trained = train(samples, None, folder, network, options).averaged_network()
        clouds = ((judged.read(each), judged.spacing(each)) for each in judged.names)
        scores = validate(trained, clouds, options.validation_vertices)
        click.echo(f"| {name} | " + " | ".join(f"{scores[column]:.3f}" for column in COLUMNS) + " |")


if __name__ == "__main__":
    main()
