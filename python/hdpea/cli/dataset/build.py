# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea dataset build``: a sample of every mesh."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from hdpea.cli.groups import GroupedCommand, GroupedOption
from hdpea.cli.parameters import quiet_option, setting_options
from hdpea.cli.types import PATH
from hdpea.dataset.options import DatasetOptions
from hdpea.errors import UsageError

if TYPE_CHECKING:
    from hdpea.dataset.build import BuildResult

EPILOG = """\b
Examples:
  hdpea dataset build meshes/ samples/
  hdpea dataset build meshes/ scans/ --kind scan --noise 0.001 --estimate
  hdpea dataset build thingi10k:34785,36371 things/ --points 100000
  hdpea dataset build meshes/ again/ --like samples/manifest.json

\b
Exit codes: 0 ok, 2 usage, 3 no meshes, 5 none usable or other bytes than --like, 130 interrupted.
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Make a sample of every mesh.")
@click.argument("meshes")
@click.argument("output", metavar="OUT", type=PATH)
@click.option(
    "--like",
    cls=GroupedOption,
    type=PATH,
    help="take every option from this manifest, and check that the result has the same bytes",
)
@quiet_option
@setting_options("sample", "sampling", "scanning", "ground_truth", "run", without=["method"], owner=DatasetOptions)
@click.pass_context
def command(ctx: click.Context, /, *, meshes: str, output: Path, like: Path | None, quiet: bool, **values: Any) -> None:
    """Make a sample of every mesh of MESHES, in the folder OUT.

    MESHES is a folder of closed meshes (PLY, OBJ, STL, OFF, GLB), one such file, or thingi10k:ID,ID.
    A MANIFEST.json beside or above them may state their licences. OUT gets one NPZ for each mesh,
    manifest.json and DATASET_CARD.md.

    A mesh that cannot be used is reported and skipped. A run that was stopped is continued by the
    same command. Lengths are shares of the diagonal of the mesh's bounding box, or spacings
    (sqrt(area / vertices)) where it says so.
    """
    from hdpea.dataset.build import build_dataset
    from hdpea.dataset.card import CARD_NAME
    from hdpea.dataset.manifest import MANIFEST_NAME, manifest_file, read_manifest
    from hdpea.dataset.manifest_options import options_from_manifest
    from hdpea.dataset.verification import require_same_bytes
    from hdpea.options.settings import RUN, filled, settings
    from hdpea.runtime.outputs import check_distinct

    wanted = None if like is None else read_manifest(like)
    check_distinct([like and manifest_file(like)], [output / MANIFEST_NAME, output / CARD_NAME])
    if wanted is None:
        options = filled(DatasetOptions, values)
    else:
        run = {each.name: values.pop(each.name) for each in settings(DatasetOptions) if each.stage == RUN}
        given = [name for name in values if ctx.get_parameter_source(name) == ParameterSource.COMMANDLINE]
        if given:
            raise UsageError(f"--like and --{given[0].replace('_', '-')} exclude each other.", "Give one of them.")
        options = options_from_manifest(wanted.options, **run)

    built = build_dataset(meshes, output, options, log=lambda line: None if quiet else click.echo(line, err=True))
    if not quiet:
        click.echo(_summary(output, built), err=True)
    if wanted is not None:
        require_same_bytes(wanted, built.manifest)


def _summary(output: Path, built: BuildResult) -> str:
    manifest = built.manifest
    skipped = sum(mesh.skipped is not None for mesh in manifest.meshes)
    size = sum(sample.bytes for sample in manifest.samples)
    made = len(manifest.meshes) - skipped - built.kept
    counts = f"meshes: {made} built, {built.kept} there already, {skipped} skipped"
    return f"{counts}\n{output}: {len(manifest.samples)} samples, {size / 1e6:.1f} MB, {built.seconds:.1f} s"
