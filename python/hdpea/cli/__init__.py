# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: ``hdpea COMMAND``; each command is the module of its name, loaded when needed."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Sequence

import click

from hdpea.cli.lazy import lazy_group
from hdpea.cli.streams import sound_streams
from hdpea.errors import HdpeaError, Interrupted, UsageError, core_errors_translated
from hdpea.runtime.interrupts import prompt_interrupts

COMMANDS = ("reconstruct", "evaluate", "embed", "curvature", "info", "view", "dataset", "train", "benchmark")
TRACEBACK = "HDPEA_TRACEBACK"

EPILOG = """\b
Begin with:
  hdpea info scan.ply
  hdpea reconstruct scan.ply mesh.obj
  hdpea reconstruct --help
"""


def _print_version(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted:
        from hdpea.version import described

        click.echo("\n".join(described()))
        ctx.exit()


def _print_manual(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted:
        from hdpea.cli.manual import manual
        from hdpea.version import version

        click.echo(manual(hdpea, ctx, version()), nl=False)
        ctx.exit()


@click.group(
    "hdpea",
    cls=lazy_group("hdpea.cli", COMMANDS),
    epilog=EPILOG,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)
@click.option(
    "--version",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_version,
    help="Show the version, and what it is made of.",
)
@click.option(
    "--man",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_manual,
    help="Print all help as a manual page, as in: hdpea --man | man -l -",
)
@click.option("--debug", is_flag=True, help=f"Show where an error came from, as {TRACEBACK}=1 does.")
def hdpea(debug: bool) -> None:
    """Compact anisotropic triangle meshes from raw point clouds."""
    if debug:
        os.environ[TRACEBACK] = "1"


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and exit with the code of what happened; the entry point of ``hdpea``."""
    with sound_streams():
        exit_code = run(arguments)
    sys.exit(exit_code)


def run(arguments: Sequence[str] | None = None) -> int:
    """Run the command with the given arguments (default: those of the process); return its exit code."""
    try:
        with prompt_interrupts(), core_errors_translated():
            hdpea.main(arguments, "hdpea", standalone_mode=False)
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message(), err=True)
        return UsageError.exit_code
    except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001 whatever it is, the user gets a sentence and a code
        return _tell(_meant(error), error)
    return 0


def _meant(error: BaseException) -> HdpeaError:
    """Return what to tell of an error."""
    match error:
        case HdpeaError():
            return error
        case click.ClickException():
            path = error.ctx.command_path if isinstance(error, click.UsageError) and error.ctx else "hdpea"
            return UsageError(error.format_message(), f"`{path} --help` explains the options.")
        case KeyboardInterrupt() | click.Abort():
            return Interrupted()
        case OSError():
            what = f"Cannot use {error.filename}" if error.filename else "The system refused"
            return HdpeaError(f"{what}: {error.strerror or error}.", "Check the names, the folders and the disk.")
        case _:
            sentence = f"Internal error: {type(error).__name__}: {error}"
            return HdpeaError(sentence, f"Please report it, with what {TRACEBACK}=1 shows.")


def _tell(told: HdpeaError, cause: BaseException) -> int:
    if os.environ.get(TRACEBACK):
        traceback.print_exception(cause)
    hint = told.hint or ("--help explains the options." if isinstance(told, UsageError) else "")
    click.echo(f"Error: {told.message}", err=True)
    if hint:
        click.echo(f"Hint: {hint}", err=True)
    return told.exit_code
