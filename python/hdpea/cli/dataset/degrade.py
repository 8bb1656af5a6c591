# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset degrade``: a sample degraded to resemble scans."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from hdpea.cli.groups import GroupedCommand
from hdpea.cli.parameters import force_option, setting_options
from hdpea.cli.types import PATH
from hdpea.dataset.options import DegradationOptions

EPILOG = """\b
Examples:
  hdpea dataset degrade bunny.npz noisy.npz --noise 0.3%
  hdpea dataset degrade bunny.npz torn.npz --missing 5 --density striped --seed 7
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Degrade a sample.")
@click.argument("source", metavar="IN", type=PATH)
@click.argument("output", metavar="OUT", type=PATH)
@force_option
@setting_options("run", owner=DegradationOptions, heading="Degradation")
def command(source: Path, output: Path, force: bool, **values: Any) -> None:
    """Degrade the sample IN to resemble a scan, and write it as OUT; both are NPZ.

    The truth remains that of the surface points that the points represent; estimated normals, if IN
    has them, are estimated again. Lengths are shares of the diagonal of the mesh's bounding box.
    """
    from hdpea.dataset.degradation import degraded
    from hdpea.dataset.normal_estimation import estimated_normals
    from hdpea.dataset.sample_file import SAMPLE_FORMATS, read_sample, write_sample
    from hdpea.options.settings import filled
    from hdpea.runtime.marks import check_replaceable
    from hdpea.runtime.outputs import check_distinct, check_output

    options = filled(DegradationOptions, values)
    check_output(output, SAMPLE_FORMATS)
    check_distinct([source], [output])
    check_replaceable({output: "sample"}, force)
    sample = read_sample(source)
    worse = degraded(sample, options)
    if sample.estimated_normals is not None:
        worse = replace(worse, estimated_normals=estimated_normals(worse.points))
    write_sample(output, worse)
