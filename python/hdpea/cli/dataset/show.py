# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset show``: a picture of a sample."""

from __future__ import annotations

from pathlib import Path

import click

from hdpea.cli.groups import GroupedCommand
from hdpea.cli.parameters import force_option
from hdpea.cli.types import PATH

EPILOG = """\b
Examples:
  hdpea dataset show samples/samples/bunny.npz bunny.png
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Draw a sample.")
@click.argument("source", metavar="IN", type=PATH)
@click.argument("output", metavar="OUT", type=PATH)
@force_option
def command(source: Path, output: Path, force: bool) -> None:
    """Draw the sample IN three times in the PNG file OUT; needs no screen.

    From left to right: the normals as colours; the first three principal components of psi as
    red, green and blue; the ratio of the stretches, from blue (1) to red, with strokes along the
    direction of the smaller curvature, along which the triangles of a mesh will be elongated.
    """
    from hdpea.dataset.sample_file import read_sample
    from hdpea.dataset.sample_picture import draw_sample
    from hdpea.pictures.picture import PICTURE_FORMATS, check_drawing
    from hdpea.runtime.marks import check_replaceable
    from hdpea.runtime.outputs import check_distinct, check_output

    check_output(output, PICTURE_FORMATS)
    check_distinct([source], [output])
    check_replaceable({output: "picture"}, force)
    check_drawing()
    draw_sample(output, read_sample(source))
