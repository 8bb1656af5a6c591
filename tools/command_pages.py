# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of docs/commands/ that say what the commands' own help says, written anew from it.

    python tools/command_pages.py docs/commands/*.md

A part stands between ``<!-- hdpea NAME -->`` and ``<!-- /hdpea NAME -->``: how the command is called, and a table of
its options. So names, defaults and explanations have one home, the options, and a test holds the pages to it. Beside an
option stands what ``benchmarks/option_pictures.py`` drew of it.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import click

from hdpea.cli import hdpea

PICTURES = Path(__file__).parents[1] / "docs/commands/pictures"
PART = re.compile(r"<!-- (hdpea [\w ]+?) -->\n.*?<!-- /\1 -->", re.DOTALL)


def context_of(name: str) -> click.Context:
    """Return the context of a command by its whole name, such as ``hdpea dataset build``."""
    first, *rest = name.split()
    context = click.Context(hdpea, info_name=first)
    for word in rest:
        group = context.command
        command = group.get_command(context, word) if isinstance(group, click.Group) else None
        if command is None:
            raise KeyError(f"There is no command {name}.")
        context = click.Context(command, info_name=word, parent=context)
    return context


def all_names(context: click.Context | None = None) -> Iterator[str]:
    """Yield the whole names of all commands that do something, in the order of the help."""
    context = context or context_of("hdpea")
    if not isinstance(context.command, click.Group):
        yield context.command_path
        return
    for word in context.command.list_commands(context):
        yield from all_names(context_of(f"{context.command_path} {word}"))


def described(name: str) -> str:
    """Return the part of a command: its usage, and its options as a table."""
    context = context_of(name)
    command = context.command
    usage = " ".join([name, *command.collect_usage_pieces(context)])
    rows = [_row(each, context) for each in command.params if isinstance(each, click.Option) and not each.hidden]
    table = ["| option | default | |", "|---|---|---|", *rows] if rows else []
    return "\n".join(["```text", usage, "```", "", *table]).rstrip()


def _row(option: click.Option, context: click.Context) -> str:
    flags = " / ".join(f"`{flag}`" for flag in [*option.opts, *option.secondary_opts])
    if isinstance(option.type, click.Choice):
        flags += " " + " \\| ".join(map(str, option.type.choices))
    explained = str(option.help or "").replace("|", "\\|")
    return f"| {flags} | {_default(option, context)} | {explained}{_picture(option, context)} |"


def _picture(option: click.Option, context: click.Context) -> str:
    """Return the picture of what an option changes, if there is one."""
    flag = option.opts[0]
    path = PICTURES / f"{context.info_name}-{flag.removeprefix('--')}.jpg"
    return f"<br>![what {flag} changes]({PICTURES.name}/{path.name})" if path.exists() else ""


def _default(option: click.Option, context: click.Context) -> str:
    """Return what the help shows in brackets, if anything."""
    shown = option.get_help_extra(context).get("default")
    return f"`{shown}`" if shown is not None else ""


def renewed(page: str) -> str:
    """Return a page with all of its parts written anew."""
    return PART.sub(lambda found: f"<!-- {found[1]} -->\n{described(found[1])}\n<!-- /{found[1]} -->", page)


if __name__ == "__main__":
    for path in map(Path, sys.argv[1:]):
        path.write_text(renewed(path.read_text()))
