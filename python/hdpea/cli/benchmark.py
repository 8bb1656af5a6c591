# SPDX-License-Identifier: GPL-3.0-or-later
"""``hdpea benchmark``: many methods on many models, by one command."""

from __future__ import annotations

from pathlib import Path

import click

from hdpea.cli.groups import GroupedCommand, GroupedOption
from hdpea.cli.parameters import quiet_option
from hdpea.cli.types import PATH
from hdpea.errors import QualityMissed, UsageError

EPILOG = """\b
Examples:
  hdpea benchmark quick results/ --meshes meshes/
  hdpea benchmark sizes results/ --meshes meshes/ --models 5 --method hdpea
  hdpea benchmark rooms results/ --meshes clouds/
  hdpea benchmark my_suite.toml results/

\b
Exit codes: 0 ok, 2 usage or a library is missing, 3 no such suite or meshes,
5 not one run gave a mesh, 130 interrupted.
"""


@click.command(cls=GroupedCommand, epilog=EPILOG, no_args_is_help=True, short_help="Compare methods on many models.")
@click.argument("suite")
@click.argument("output", metavar="OUT", type=PATH)
@click.option("--meshes", cls=GroupedOption, help="folder of the true meshes (rooms: of clouds), or thingi10k:ID,ID")
@click.option(
    "--method",
    "methods",
    cls=GroupedOption,
    multiple=True,
    help="only this one of the suite; may be repeated",
)
@click.option("--models", cls=GroupedOption, type=int, help="number of models, evenly over their names; 0: all")
@click.option(
    "--page",
    cls=GroupedOption,
    is_flag=True,
    help="also a page for each model pictured, to turn the results side by side; index.html links to them",
)
@quiet_option
def command(
    *,
    suite: str,
    output: Path,
    meshes: str | None,
    methods: tuple[str, ...],
    models: int | None,
    page: bool,
    quiet: bool,
) -> None:
    """Run the methods of SUITE on points of true meshes, and evaluate and compare the results in OUT.

    SUITE is quick, sampling, scans, robustness, raw, normals, points, sizes, two_stage, roughness,
    large, pmei, rooms (real clouds, half of whose points are held out as the truth) or failure, or a
    TOML file of your own: inputs and how they are degraded, methods and their options, numbers of
    vertices. OUT gets results.csv, results.md, index.html with all tables and pictures in it, and
    the points and meshes themselves.

    Each run has a process and a time limit of its own. Finished runs are kept: the same
    command resumes a suite that was stopped. Other methods need pip install 'hdpea[benchmark]'.
    """
    from hdpea.benchmark.gallery import draw_gallery
    from hdpea.benchmark.results import write_results
    from hdpea.benchmark.run import run_suite
    from hdpea.benchmark.suite_file import read_suite
    from hdpea.pictures.picture import check_drawing

    wanted = read_suite(suite, methods, models)
    where = meshes or wanted.meshes
    if not where:
        raise UsageError("The suite does not say where the meshes are.", "Add --meshes FOLDER.")
    if wanted.options.pictures or wanted.options.rendered:
        check_drawing()

    def log(line: str) -> None:
        if not quiet:
            click.echo(line, err=True)

    records = run_suite(wanted, where, output, log)
    if page:
        from hdpea.benchmark.model_pages import write_model_pages

        write_model_pages(wanted, where, output, records, log)
    write_results(output, wanted, records, draw_gallery(wanted, where, output, records, log))
    log(f"{output / 'index.html'}: {len(records)} runs, {sum(bool(each.failed) for each in records)} failed")
    if all(each.failed for each in records):
        raise QualityMissed("Not one run gave a mesh.", f"The reasons are in {output / 'results.md'}.")
