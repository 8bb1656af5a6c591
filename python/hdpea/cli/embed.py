# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea embed``: the embedding alone, for those who want to build on it."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import click

from hdpea.cli.config import config_of, config_option
from hdpea.cli.destinations import require_no_scan
from hdpea.cli.groups import GroupedCommand, GroupedOption, in_flags
from hdpea.cli.parameters import chosen_options, force_option, quiet_option, setting_options
from hdpea.cli.types import PATH

EPILOG = """\b
Examples:
  hdpea embed scan.ply embedding.npz
  hdpea embed scan.ply embedding.ply --curvature-radius 1%
  hdpea embed scan.ply embedding.npz --embedding learned --json > chosen.json
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Embed a point cloud into R^8.")
@click.argument("source", metavar="IN", type=click.Path())
@click.argument("output", metavar="OUT", type=PATH)
@config_option
@force_option
@click.option("--json", "as_json", cls=GroupedOption, is_flag=True, help="print what was chosen, in full, as JSON")
@quiet_option
@setting_options("cleaning", "normals", "embedding", "run", also=["vertices", "particles"], without=["texture"])
@click.pass_context
def command(
    ctx: click.Context, /, *, source: str, output: Path, force: bool, as_json: bool, quiet: bool, **values: Any
) -> None:
    """Embed the point cloud IN into R^8, where distances are lengths under the curvature metric.

    OUT is NPZ (arrays points and normals of shape (n, 3), coordinates of shape (n, 8)) or PLY
    (embedding_0 to embedding_7 as properties of the points). IN is as for reconstruct. It shows
    as much detail as a mesh with a vertex for every 8 points, or with --vertices where these are more.
    Points that lie on no surface or crowd on scan lines are left out; point_index says which of IN
    are there.
    """
    options = chosen_options(ctx, values)
    from hdpea.reading import read_points
    from hdpea.runtime.marks import check_replaceable
    from hdpea.runtime.outputs import check_distinct, check_output
    from hdpea.runtime.progress import shown, tell
    from hdpea.writing.points import POINT_FORMATS, write_points

    check_output(output, POINT_FORMATS)
    check_distinct([source, options.embedding.weights, config_of(ctx)], [output])
    require_no_scan(output, "embedding")
    check_replaceable({output: "embedding"}, force)
    with shown(quiet) as progress:
        tell(progress, "reading", 0.0)
        cloud = read_points(source)
        tell(progress, "start-up", 0.0)
        from hdpea.embedding import embed_points

        embedding = embed_points(cloud, options=options, progress=progress)
        tell(progress, "writing", 0.0)
        write_points(output, embedding.points, embedding.normals, embedding.coordinates, embedding.point_index)
    if as_json:
        told = {"choices": [asdict(each) for each in embedding.choices], "notes": list(embedding.notes)}
        click.echo(json.dumps(told, indent=2))
    if not quiet:
        from hdpea.report.summary import describe

        click.echo("\n".join([*map(describe, embedding.choices), *map(in_flags, embedding.notes)]), err=True)
