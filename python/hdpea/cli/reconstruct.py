# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea reconstruct``: the main job.

Most flags are fields of the options: a new one is a new field in ``hdpea/options``, in the module of its stage.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from hdpea.cli.config import config_of, config_option
from hdpea.cli.destinations import FORMATS, destinations, require_no_scan
from hdpea.cli.ended import Ended
from hdpea.cli.groups import GroupedCommand, GroupedOption, in_flags
from hdpea.cli.job import Job, make_mesh, missed, remarks
from hdpea.cli.parameters import chosen_options, force_option, quiet_option, setting_options, up_option
from hdpea.cli.tiles import MemoryType, Resources
from hdpea.cli.types import PATH
from hdpea.errors import HdpeaError, UsageError
from hdpea.runtime.marks import check_replaceable, is_marked
from hdpea.runtime.outputs import check_distinct, check_output

EPILOG = """\b
Examples:
  hdpea reconstruct scan.ply                # makes scan.mesh.ply
  hdpea reconstruct scan.ply mesh.obj
  hdpea reconstruct scan.ply mesh.ply --vertices 5000 --report report.json
  hdpea reconstruct scan.xyz mesh.glb --faces 20000 --picture mesh.png --page mesh.html
  hdpea reconstruct a.ply b.laz c.e57 --out-dir meshes/ --json > made.jsonl
  hdpea reconstruct front.ply back.ply mesh.ply --merge
  ssh there cat scan.laz | hdpea reconstruct - - --format stl > mesh.stl

\b
Exit codes: 0 ok, 1 internal error, 2 usage, 3 unreadable input,
4 cannot reconstruct, 5 quality target missed, 130 interrupted, 143 terminated.
Of several meshes, the gravest: 1, 4, 3, 2, then 5.
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Make a mesh of a point cloud.")
@click.argument("files", metavar="IN... [OUT]", nargs=-1, required=True, type=click.Path())
@click.option("--out-dir", cls=GroupedOption, type=PATH, help="folder for a mesh of each IN, called IN.mesh.ply")
@click.option(
    "--jobs",
    cls=GroupedOption,
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    help="processes: with --out-dir, how many meshes are made at a time; else, how many work on tiles",
)
@click.option(
    "--memory",
    cls=GroupedOption,
    type=MemoryType(),
    help="memory to take, as 4GB; larger clouds are made in tiles; default: half of what the machine has",
)
@click.option("--work-dir", cls=GroupedOption, type=PATH, help="folder for tiles meanwhile; default: OUT.tiles")
@click.option(
    "--scheduler", cls=GroupedOption, help="Dask scheduler whose workers work on the tiles, as tcp://host:8786"
)
@click.option("--merge", cls=GroupedOption, is_flag=True, help="take all IN as scans of one thing, in one frame")
@click.option(
    "--format",
    "mesh_format",
    cls=GroupedOption,
    type=click.Choice(FORMATS, case_sensitive=False),
    help="of a mesh whose name does not say it: that of --out-dir, of no OUT (default: ply), or -",
)
@click.option("--report", cls=GroupedOption, type=PATH, help="write what was chosen and measured, as JSON")
@click.option(
    "--dropped", cls=GroupedOption, type=PATH, help="write the points that were left out and why, as PLY or NPZ"
)
@click.option("--picture", cls=GroupedOption, type=PATH, help="draw the mesh, as PNG; needs no screen")
@click.option(
    "--page", cls=GroupedOption, type=PATH, help="show mesh and points as an HTML file, for any browser, offline"
)
@up_option
@config_option
@force_option
@click.option("--json", "as_json", cls=GroupedOption, is_flag=True, help="print one line of JSON for each mesh")
@click.option("--verbose", cls=GroupedOption, is_flag=True, help="also say what was chosen, and why")
@quiet_option
@setting_options("meshing", "cleaning", "normals", "denoising", "embedding", "particles", "refinement", "run")
@click.pass_context
def command(
    ctx: click.Context,
    /,
    *,
    files: tuple[str, ...],
    out_dir: Path | None,
    jobs: int,
    memory: float | None,
    work_dir: Path | None,
    scheduler: str | None,
    merge: bool,
    mesh_format: str | None,
    report: Path | None,
    dropped: Path | None,
    picture: Path | None,
    page: Path | None,
    up: str | None,
    force: bool,
    as_json: bool,
    verbose: bool,
    quiet: bool,
    **values: Any,
) -> None:
    """Make a compact anisotropic triangle mesh of the point cloud IN.

    IN is PLY, text (XYZ, CSV, PTS, PWN), LAS, LAZ, E57, PCD, PTX, OBJ, OFF, NPY or NPZ, gzipped or
    not; - reads standard input. Normals and sensors are used if there are any. OUT is OBJ, PLY, STL,
    OFF or GLB, by its extension; - is standard output. Without OUT the mesh is IN.mesh.ply, beside
    IN.

    No IN is ever overwritten, nor is a scan in the place of OUT.

    Lengths are in the units of the file, or in percent of the diagonal of the cloud's bounding box.
    """
    options = chosen_options(ctx, values)
    if out_dir is not None and (report or dropped or picture or page):
        raise UsageError(
            "`report`, `dropped`, `picture` and `page` are of one mesh, not of several.", "`as_json` tells of each."
        )
    if out_dir is not None and (work_dir is not None or verbose):
        raise UsageError(
            "`work_dir` and `verbose` are for one mesh, not for several.",
            "Tiles lie in `out_dir` meanwhile; `as_json` tells what was chosen.",
        )
    if out_dir is not None:
        files = _without_own(files, quiet)
    # The processes of several meshes share the memory; each works on its tiles, if any, alone.
    resources = Resources(memory, jobs, scheduler, work_dir)
    if out_dir is not None:
        resources = Resources(resources.bytes() / jobs, scheduler=scheduler)
    wanted = [
        Job(each, options, report, dropped, picture, page, up, resources)
        for each in destinations(files, out_dir, merge, mesh_format)
    ]
    if as_json and wanted[0].destination.output is None:
        raise UsageError("Standard output is for the mesh or for `as_json`, not for both.", "Give a `report` instead.")
    if options.meshing.lod > 1 and wanted[0].destination.output is None:
        raise UsageError("Standard output is for one mesh, not for the levels of `lod`.", "Name the mesh.")
    if out_dir is not None:
        _make_folder(out_dir)
    _check_outputs(wanted, [options.embedding.weights, config_of(ctx)], force)
    from hdpea.runtime.pytorch import check_pytorch

    check_pytorch()
    if out_dir is not None:
        _make_each(wanted, jobs, out_dir, as_json, quiet)
    else:
        _make_one(wanted[0], as_json, quiet, verbose)


def _without_own(files: Sequence[str], quiet: bool) -> tuple[str, ...]:
    """Leave out meshes that an earlier run of the same command made, which ``*.ply`` takes for clouds; say so."""
    own = [file for file in files if Path(file).is_file() and is_marked(Path(file), "mesh")]
    if own and not quiet:
        click.echo(f"Left out, since they are meshes that hdpea made: {', '.join(own)}.", err=True)
    if len(own) == len(files):
        raise UsageError("All of the files are meshes that hdpea made.", "Name one alone to make a mesh of a mesh.")
    return tuple(file for file in files if file not in own)


def _check_outputs(wanted: Sequence[Job], read: Sequence[Path | str | None], force: bool) -> None:
    from hdpea.pages.page import PAGE_FORMATS
    from hdpea.pictures.picture import PICTURE_FORMATS, check_drawing
    from hdpea.writing.meshes import MESH_FORMATS
    from hdpea.writing.points import POINT_FORMATS

    formats = {
        "mesh": MESH_FORMATS,
        "report": [".json"],
        "placement": [".json"],
        "picture": PICTURE_FORMATS,
        "page": PAGE_FORMATS,
    }
    formats |= {"material": [".mtl"], "texture": [".png"]}
    kinds: dict[Path, str] = {}
    for job in wanted:
        for path, kind in job.outputs():
            check_output(path, formats.get(kind, POINT_FORMATS))
            kinds[path] = kind
    sources = [source for job in wanted for source in job.destination.sources]
    check_distinct([*sources, *read], [path for job in wanted for path, _ in job.outputs()])
    for job in wanted:
        if job.picture:
            check_drawing()
        _check_texture(job)
        require_no_scan(job.destination.output)
    check_replaceable(kinds, force)


def _check_texture(job: Job) -> None:
    from hdpea.writing.meshes import check_textured

    textured, destination = job.options.texture is not None, job.destination
    check_textured(destination.extension, textured)
    if textured and destination.extension == ".obj" and destination.output is None:
        raise UsageError("An OBJ with a `texture` is several files.", "Name the file, or write GLB.")


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"Cannot make the folder {folder}: {error.strerror}.", "Choose another.") from error


def _make_one(job: Job, as_json: bool, quiet: bool, verbose: bool) -> None:
    from hdpea.report.summary import summarize
    from hdpea.runtime.progress import shown

    try:
        with shown(quiet) as progress:
            report = make_mesh(job, progress)
        error = missed(job, report)
        if as_json:
            click.echo(Ended.of(job.destination, report, error).as_line())
        if not quiet:
            click.echo(in_flags(summarize(report, job.destination.name, verbose)), err=True)
            for line in remarks(job, report):
                click.echo(line, err=True)
    except HdpeaError as failed:
        if as_json:
            click.echo(Ended.of(job.destination, None, failed).as_line())
        raise
    if error is not None:
        raise error


def _make_each(jobs: Sequence[Job], parallel: int, out_dir: Path, as_json: bool, quiet: bool) -> None:
    from hdpea.cli.batch import meshes_of_each, worst_of

    all_ended = []
    for ended in meshes_of_each(jobs, parallel, out_dir):
        all_ended.append(ended)
        if as_json:
            click.echo(ended.as_line())
            sys.stdout.flush()
        if ended.kind is not None:
            click.echo(f"{ended.name}: {ended.message} {ended.hint}".rstrip(), err=True)
        elif not quiet:
            click.echo(f"{ended.name}: {'; '.join(ended.summary)}", err=True)
    error = worst_of(all_ended)
    if error is not None:
        raise error
