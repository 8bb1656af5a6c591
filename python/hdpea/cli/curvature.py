# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea curvature``: curvature tensors of a cloud."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

from hdpea.cli.destinations import require_no_scan
from hdpea.cli.groups import GroupedCommand, GroupedOption, in_flags
from hdpea.cli.parameters import force_option, quiet_option, setting_options
from hdpea.cli.types import PATH
from hdpea.curvature.options import NORMAL_NEIGHBORS_HELP, CurvatureOptions
from hdpea.options.settings import filled
from hdpea.runtime.marks import check_replaceable
from hdpea.runtime.outputs import check_distinct, check_output

EPILOG = """\b
Examples:
  hdpea curvature scan.ply curvature.ply
  hdpea curvature scan.ply curvature.csv --method jet
  hdpea curvature scan.ply curvature.npz --picture glyphs.png --page glyphs.html

\b
Exit codes: 0 ok, 1 internal error, 2 usage, 3 unreadable input,
4 cannot reconstruct, 130 interrupted.
"""

HELPS = {"normal_neighbors": NORMAL_NEIGHBORS_HELP}


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Estimate curvature tensors.")
@click.argument("source", metavar="IN", type=click.Path())
@click.argument("output", metavar="OUT", type=PATH)
@click.option("--picture", cls=GroupedOption, type=PATH, help="draw the tensors, as PNG; needs no screen")
@click.option(
    "--page",
    cls=GroupedOption,
    type=PATH,
    help="draw them as an HTML file to turn and zoom, in any browser, offline",
)
@force_option
@click.option("--json", "as_json", cls=GroupedOption, is_flag=True, help="print what was chosen and found as JSON")
@quiet_option
@setting_options("estimation", "cleaning", "normals", "embedding", "run", owner=CurvatureOptions, helps=HELPS)
def command(
    *,
    source: str,
    output: Path,
    picture: Path | None,
    page: Path | None,
    force: bool,
    as_json: bool,
    quiet: bool,
    **values: Any,
) -> None:
    """Estimate the curvature tensor at each point of the cloud IN.

    OUT is PLY or CSV (a column for each number), NPZ or VTP (an array for each quantity), by its
    extension: principal directions 1 and 2, of the curvature of larger magnitude and of the other;
    curvature1 and curvature2 in 1 / length; stretch1, stretch2 and their stretching_ratio; the
    metric tensor; the normal; and whether the directions are determined. Where the surface is flat
    or round they are not, and are written as 0. Points that lie on no surface are left out. IN is as
    for reconstruct.

    A curvature from the embedding is a magnitude, within the range that the command tells; those
    from jets have signs, positive where the surface is convex.

    Lengths are in the units of the file, or in percent of the diagonal of the cloud's bounding box.
    """
    options = filled(CurvatureOptions, values)
    _check_outputs(output, picture, page)
    check_distinct([source, options.embedding.weights], [output, picture, page])
    require_no_scan(output, "curvature")
    kinds = {output: "curvature", picture: "picture", page: "page"}
    check_replaceable({path: kind for path, kind in kinds.items() if path is not None}, force)
    from hdpea.curvature.estimation import estimate_curvature
    from hdpea.curvature.writing import write_curvature
    from hdpea.reading import read_points
    from hdpea.runtime.progress import shown, tell

    with shown(quiet) as progress:
        tell(progress, "reading", 0.0)
        cloud = read_points(source)
        tensors = estimate_curvature(cloud, options=options, progress=progress)
        tell(progress, "writing", 0.0)
        write_curvature(output, tensors)
        if picture:
            from hdpea.curvature.drawing import draw_curvature

            tell(progress, "picture", 0.0)
            draw_curvature(picture, tensors)
        if page:
            from hdpea.curvature.page import write_page

            tell(progress, "page", 0.0)
            write_page(page, tensors, title=Path(source).name)
    if as_json:
        from hdpea.curvature.summary import as_dict

        click.echo(json.dumps(as_dict(tensors), indent=2))
    if not quiet:
        from hdpea.curvature.summary import summarize

        click.echo(in_flags("\n".join(summarize(tensors))), err=True)


def _check_outputs(output: Path, picture: Path | None, page: Path | None) -> None:
    from hdpea.curvature.writing import check_curvature_output

    check_curvature_output(output)
    if picture:
        from hdpea.pictures.picture import PICTURE_FORMATS, check_drawing

        check_output(picture, PICTURE_FORMATS)
        check_drawing()
    if page:
        from hdpea.pages.page import PAGE_FORMATS

        check_output(page, PAGE_FORMATS)
