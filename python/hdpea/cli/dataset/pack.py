# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset pack``: datasets as one small file to train on."""

from __future__ import annotations

from pathlib import Path

import click

from hdpea.cli.groups import GroupedCommand
from hdpea.cli.parameters import force_option
from hdpea.cli.types import PATH

EPILOG = """\b
Examples:
  hdpea dataset pack samples/ scans/ packed.safetensors
  hdpea train packed.safetensors training/ --preset gpu
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Pack datasets to train on.")
@click.argument("datasets", metavar="DATASET...", nargs=-1, required=True, type=PATH)
@click.argument("output", metavar="OUT", type=PATH)
@force_option
def command(datasets: tuple[Path, ...], output: Path, force: bool) -> None:
    """Pack the samples of each DATASET, a folder that `hdpea dataset build` made, into the file OUT.

    OUT is SAFETENSORS, a third as large, and what `hdpea train` reads fastest. It holds what a
    training looks at, in 16 bits, and no licences: keep the data cards.
    """
    from hdpea.dataset.loading import Dataset
    from hdpea.runtime.marks import check_replaceable
    from hdpea.runtime.outputs import check_output
    from hdpea.runtime.pytorch import check_pytorch

    check_pytorch()
    from hdpea.training.joined import Joined
    from hdpea.training.packed import KIND, PACKED_FORMATS, write_packed

    check_output(output, PACKED_FORMATS)
    check_replaceable({output: KIND}, force)
    write_packed(output, Joined([Dataset(folder) for folder in datasets]))
