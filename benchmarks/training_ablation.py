# SPDX-License-Identifier: GPL-3.0-or-later
"""Ablation of the training: each loss with the same number of steps, compared by reconstructions.

    python benchmarks/training_ablation.py TRAINING VALIDATION OUT [--steps 1500] [--stem] [--picture DIR]

TRAINING and VALIDATION are folders made by `hdpea dataset build`. Each loss trains a network of its own in a folder of
OUT, so that a stopped run can be resumed; its weights are written beside that folder, for losses.toml. Then clouds of
VALIDATION are reconstructed by each network, alone and followed by rounds of the solver. The losses ndhde-* and point-*
are those of the HD-PEA paper (Table 4). Prints Markdown.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import click
from side_by_side import draw_side_by_side

from hdpea.dataset.loading import Dataset
from hdpea.network.options import CONFIGURATIONS
from hdpea.network.settling import ROUNDS
from hdpea.network.transformer import PointTransformer
from hdpea.network.weights import write_weights
from hdpea.training.loop import train
from hdpea.training.options import LOSSES, PRESETS, LossOptions
from hdpea.training.validation import mesh_of_sample, validate

COLUMNS = {"t3": "T3", "g": "G"}
ROUNDS_AFTER = {"alone": 0, "settled": ROUNDS}
"""Rounds of the solver after the network."""


@click.command()
@click.argument("training", type=click.Path(exists=True, path_type=Path))
@click.argument("validation", type=click.Path(exists=True, path_type=Path))
@click.argument("out", type=click.Path(file_okay=False, path_type=Path))
@click.option("--steps", default=1500, show_default=True)
@click.option("--clouds", default=5, show_default=True, help="clouds of VALIDATION to reconstruct, spread over it")
@click.option("--stem", is_flag=True, help="compare inputs of the network for curvature instead of losses")
@click.option(
    "--picture",
    type=click.Path(path_type=Path),
    help="folder for pictures without the solver: rows of the table from left to right",
)
def main(
    *, training: Path, validation: Path, out: Path, steps: int, clouds: int, stem: bool, picture: Path | None
) -> None:
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
        rows["nothing"] = (compact, None)
    samples, judged = Dataset(training), Dataset(validation)
    names = [judged.names[place * len(judged.names) // clouds] for place in range(clouds)]
    click.echo(f"{steps} steps each on {len(samples)} clouds; means over {', '.join(names)}\n")
    heads = [f"{head}, {after}" for after in ROUNDS_AFTER for head in COLUMNS.values()]
    click.echo("| trained with | " + " | ".join(heads) + " |\n" + "|---" * (1 + len(heads)) + "|")
    networks = []
    for name, (network, options) in rows.items():
        if options is None:
            trained = PointTransformer(network, samples.metric.of_clouds())
        else:
            folder = out / name.replace(" ", "_")
            folder.mkdir(parents=True, exist_ok=True)
            trained = train(samples, None, folder, network, options).averaged_network()
        write_weights(out / f"{name.replace(' ', '_')}.safetensors", trained)
        networks.append(trained)
        cells = []
        for rounds in ROUNDS_AFTER.values():
            read = ((judged.read(each), judged.spacing(each)) for each in names)
            scores = validate(trained, read, preset.validation_vertices, rounds)
            cells += [f"{scores[column]:.3f}" for column in COLUMNS]
        click.echo(f"| {name} | " + " | ".join(cells) + " |")
    if picture:
        for cloud in names:
            sample, spacing = judged.read(cloud), judged.spacing(cloud)
            made = (mesh_of_sample(each, sample, spacing, preset.validation_vertices, rounds=0) for each in networks)
            draw_side_by_side(picture / f"{cloud}.png", [(mesh.vertices_in_unit, mesh.faces) for mesh in made])


if __name__ == "__main__":
    main()
