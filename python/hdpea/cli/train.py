# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea train``: a network from a dataset."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from hdpea.cli.groups import GroupedCommand, GroupedOption
from hdpea.cli.parameters import quiet_option, setting_options
from hdpea.cli.types import PATH
from hdpea.errors import UsageError
from hdpea.network.options import CONFIGURATIONS
from hdpea.options.settings import as_dict, filled
from hdpea.training.options import PRESETS, TrainingOptions

EPILOG = """\b
Examples:
  hdpea train dataset/ training/ --validation validation/
  hdpea train dataset/ training/ --steps 100000     # resumes where it was stopped
  hdpea train dataset/ training/ --preset gpu --minutes 10
  torchrun --nproc-per-node 2 -m hdpea train dataset/ training/ --batch 2
"""


def _use_preset(ctx: click.Context, _: click.Parameter, name: str) -> str:
    ctx.default_map = {key: value for stage in as_dict(PRESETS[name]).values() for key, value in stage.items()}
    return name


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Train a network to embed.")
@click.argument("dataset", type=PATH)
@click.argument("out", type=PATH)
@click.option(
    "--also",
    cls=GroupedOption,
    type=PATH,
    multiple=True,
    help="a further dataset to train on, such as one of scans; may be repeated",
)
@click.option(
    "--validation",
    cls=GroupedOption,
    type=PATH,
    help="dataset whose clouds are reconstructed at intervals, to keep the best weights",
)
@click.option(
    "--start",
    cls=GroupedOption,
    type=PATH,
    help="weights to start from (fine-tuning), of the same network and metric; default: random ones",
)
@click.option(
    "--network",
    cls=GroupedOption,
    type=click.Choice(list(CONFIGURATIONS)),
    default="compact",
    show_default=True,
    help="size of the network; base is HD-PEA's",
)
@click.option(
    "--preset",
    cls=GroupedOption,
    type=click.Choice(list(PRESETS)),
    default="cpu",
    show_default=True,
    is_eager=True,
    expose_value=False,
    callback=_use_preset,
    help="defaults of the flags below, shown for cpu; gpu: ten minutes of one; paper: as in the HD-PEA paper",
)
@click.option("--tensorboard", cls=GroupedOption, is_flag=True, help="also write for TensorBoard, if it is installed")
@quiet_option
@setting_options("run", "crops", "loss", owner=TrainingOptions)
@click.pass_context
def command(
    ctx: click.Context,
    /,
    *,
    dataset: Path,
    out: Path,
    also: tuple[Path, ...],
    validation: Path | None,
    start: Path | None,
    network: str,
    tensorboard: bool,
    quiet: bool,
    **values: Any,
) -> None:
    """Train a network on DATASET, what `hdpea dataset build` or `pack` made, into the folder OUT.

    OUT gets last.pt, from which the same command resumes, best.pt with what reconstructed the
    validation clouds best, the averaged weights of both as .safetensors, and metrics.jsonl. Each
    can be read at any moment. Ctrl-C saves and stops.

    A .safetensors is what `hdpea reconstruct --embedding learned --weights` takes.
    """
    lengths = ("steps", "epochs", "minutes")
    given = [name for name in lengths if ctx.get_parameter_source(name) is ParameterSource.COMMANDLINE]
    if len(given) > 1:
        raise UsageError(f"`{given[0]}` and `{given[1]}` exclude each other.", "Give one of them.")
    if given:  # instead of what the preset says
        values |= {name: None for name in lengths[1:] if name not in given}
    options = filled(TrainingOptions, values)
    from hdpea.dataset.loading import Dataset
    from hdpea.runtime.outputs import check_output
    from hdpea.runtime.pytorch import check_pytorch

    check_pytorch()
    from hdpea.training.journal import LAST
    from hdpea.training.packed import Packed
    from hdpea.training.stopping import stop_requests
    from hdpea.training.workers import joined_workers

    datasets = [Packed(path) if path.is_file() else Dataset(path) for path in (dataset, *also)]
    judged = Dataset(validation) if validation else None
    out.mkdir(exist_ok=True) if out.parent.is_dir() else None
    check_output(out / LAST, [".pt"])
    from hdpea.network.weights import read_weights
    from hdpea.training.joined import Joined
    from hdpea.training.loop import train

    def tell(line: str) -> None:
        if not quiet:
            click.echo(line, err=True)

    first = read_weights(start) if start else None
    with joined_workers(options.device) as workers, stop_requests() as stopped:
        tell(f"device: {workers.device}")
        samples, shape = Joined(datasets), CONFIGURATIONS[network]
        train(samples, judged, out, shape, options, stopped, workers, tensorboard, tell, first)
