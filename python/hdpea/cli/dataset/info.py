# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset info``: the content of a dataset, or of one sample."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from hdpea.cli.groups import GroupedCommand
from hdpea.cli.types import PATH

if TYPE_CHECKING:
    from hdpea.dataset.loading import Dataset
    from hdpea.dataset.statistics import SampleStatistics

EPILOG = """\b
Examples:
  hdpea dataset info samples/
  hdpea dataset info samples/samples/bunny.npz
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Describe a dataset.")
@click.argument("source", metavar="IN", type=PATH)
def command(source: Path) -> None:
    """Describe the dataset, or the sample, IN.

    All files of a dataset are read and checked. Curvatures are per unit length, lengths shares of
    the diagonal of the mesh's bounding box. The isometry error is that of distances in R^8 between
    neighbours, as a share of their length under the metric; the roughness is the distance of neighbours
    from their plane there. For a single sample the metric is the default one, since its file does
    not contain the metric that it was made with.
    """
    if source.is_dir():
        from hdpea.dataset.loading import Dataset

        click.echo(_describe_dataset(Dataset(source)))
    else:
        from hdpea.dataset.options import GroundTruthOptions
        from hdpea.dataset.sample_file import read_sample
        from hdpea.dataset.statistics import sample_statistics

        sample = read_sample(source)
        facts = sample_statistics(sample, GroundTruthOptions())
        centre = " ".join(f"{each:.6g}" for each in sample.frame.centre_in_world)
        rows = {
            "points": f"{facts.points:,}",
            "also holds": ", ".join(facts.optional) or "nothing",
            "frame": f"diagonal {sample.frame.diagonal:.6g} around {centre}",
        }
        click.echo("\n".join([*_columns(rows), "", *_ranges([facts])]))


def _describe_dataset(dataset: Dataset) -> str:
    from hdpea.dataset.card import licence_table
    from hdpea.dataset.manifest_options import options_from_manifest
    from hdpea.dataset.statistics import sample_statistics

    manifest = dataset.manifest
    metric = options_from_manifest(manifest.options).ground_truth
    facts = [sample_statistics(sample, metric) for sample in dataset]
    used = [mesh for mesh in manifest.meshes if mesh.skipped is None]
    rows = {
        "built by": f"hdpea {manifest.hdpea}",
        "samples": f"{len(dataset):,} of {len(used):,} meshes, all whole",
        "points": f"{sum(each.points for each in manifest.samples):,}",
        "size": f"{sum(each.bytes for each in manifest.samples) / 1e6:.1f} MB",
    }
    for stage, values in manifest.options.items():
        rows[stage.replace("_", " ")] = ", ".join(f"{name} {value}" for name, value in values.items())
    skipped = [f"skipped {mesh.name}: {mesh.skipped}" for mesh in manifest.meshes if mesh.skipped is not None]
    licences = ["| licence of the mesh | meshes | samples |", "|---|---|---|", licence_table(used)]
    return "\n".join([*_columns(rows), *skipped, "", *_ranges(facts), "", *licences])


def _ranges(facts: list[SampleStatistics]) -> list[str]:
    """Return a table of the ranges; over several samples the minimum, medians of the percentiles, and maximum."""
    import numpy as np

    header = "".join(f"{name:>10}" for name in ("least", "5 %", "median", "95 %", "most"))
    lines = [f"{'':<26}{header}"]
    for name in facts[0].ranges if facts else ():
        table = np.stack([each.ranges[name] for each in facts])
        values = [table[:, 0].min(), *np.median(table[:, 1:-1], axis=0), table[:, -1].max()]
        lines.append(f"{name:<26}" + "".join(f"{value:>10.4g}" for value in values))
    return lines


def _columns(rows: dict[str, str]) -> list[str]:
    return [f"{name:<14}{value}" for name, value in rows.items()]
