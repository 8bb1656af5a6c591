# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea reconstruct``: the main job.

Most flags are fields of the options: a new one is a new field in ``hdpea/options``, in the module of its stage.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import click

from hdpea.cli.config import config_of, config_option
from hdpea.cli.parameters import PATH, GroupedCommand, GroupedOption, chosen_options, quiet_option, setting_options
from hdpea.errors import QualityMissed
from hdpea.runtime.outputs import check_distinct, check_output

EPILOG = """\b
Examples:
  hdpea reconstruct scan.ply mesh.obj
  hdpea reconstruct scan.ply mesh.ply --vertices 5000 --report report.json
  hdpea reconstruct scan.xyz mesh.glb --faces 20000 --picture mesh.png
  zcat scan.xyz.gz | hdpea reconstruct - mesh.stl --watertight --fill-holes 5%

\b
Exit codes: 0 ok, 1 internal error, 2 usage, 3 unreadable input,
4 cannot reconstruct, 5 quality target missed, 130 interrupted, 143 terminated.
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Make a mesh of a point cloud.")
@click.argument("source", metavar="IN")
@click.argument("output", metavar="OUT", type=PATH)
@click.option("--report", cls=GroupedOption, type=PATH, help="write what was chosen and measured, as JSON")
@click.option(
    "--dropped", cls=GroupedOption, type=PATH, help="write the points that were left out and why, as PLY or NPZ"
)
@click.option("--picture", cls=GroupedOption, type=PATH, help="draw the mesh, as PNG; needs no screen")
@config_option
@quiet_option
@setting_options("meshing", "cleaning", "normals", "denoising", "embedding", "particles", "refinement", "run")
@click.pass_context
def command(
    ctx: click.Context,
    /,
    *,
    source: str,
    output: Path,
    report: Path | None,
    dropped: Path | None,
    picture: Path | None,
    quiet: bool,
    **values: Any,
) -> None:
    """Make a compact anisotropic triangle mesh of the point cloud IN.

    IN is PLY, text (XYZ, CSV, PTS, PWN), OBJ, OFF, NPY or NPZ; - reads standard input. Normals are
    used if there are any. OUT is OBJ, PLY, STL, OFF or GLB, by its extension.

    Lengths are in the units of the file, or in percent of the diagonal of the cloud's bounding box.
    """
    options = chosen_options(ctx, values)
    _check_outputs(output, report, dropped, picture)
    from hdpea.writing.placement import placement_file

    check_distinct(
        [source, options.embedding.weights, config_of(ctx)], [output, placement_file(output), report, dropped, picture]
    )
    from hdpea.reading import read_points
    from hdpea.runtime.clock import StageClock
    from hdpea.runtime.progress import shown, tell
    from hdpea.writing.meshes import write_mesh

    clock = StageClock()
    with shown(quiet) as progress:
        tell(progress, "reading", 0.0)
        with clock.stage("reading"):
            cloud = read_points(source)
        # Torch takes seconds to load, so this comes after all that may be wrong with the request.
        tell(progress, "start-up", 0.0)
        with clock.stage("start-up"):
            from hdpea.reconstruction import reconstruct

            # Or the clock would not see it: the stages load it when they first need it.
            import_module("torch")
        result = reconstruct(cloud, options=options, progress=progress)
        result.report.begin_with(source, clock)
        tell(progress, "writing", 0.0)
        with result.report.clock.stage("writing"):
            write_mesh(output, result.vertices, result.faces, result.attributes, result.crs)
        if report:
            result.report.write(report)
        if dropped:
            from hdpea.writing.points import write_dropped

            write_dropped(dropped, result.dropped.points, result.dropped.reasons)
        if picture:
            from hdpea.pictures.camera import mean_sight
            from hdpea.pictures.picture import Camera, draw_mesh

            tell(progress, "picture", 0.0)
            camera = Camera.before(result.vertices, result.faces, mean_sight(cloud.points, cloud.sensors()))
            draw_mesh(picture, result.vertices, result.faces, camera=camera)
    if not quiet:
        from hdpea.report.summary import summarize

        click.echo(summarize(result.report), err=True)
    if result.report.missed:
        raise QualityMissed(" ".join(result.report.missed), f"The mesh is in {output} all the same.")


def _check_outputs(output: Path, report: Path | None, dropped: Path | None, picture: Path | None) -> None:
    from hdpea.pictures.picture import PICTURE_FORMATS, check_drawing
    from hdpea.writing.meshes import MESH_FORMATS, POINT_FORMATS

    check_output(output, MESH_FORMATS)
    if report:
        check_output(report, [".json"])
    if dropped:
        check_output(dropped, POINT_FORMATS)
    if picture:
        check_output(picture, PICTURE_FORMATS)
        check_drawing()
