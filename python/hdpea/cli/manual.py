# SPDX-License-Identifier: GPL-3.0-or-later
"""The help of all commands as one manual page, for ``man``."""

from __future__ import annotations

import inspect
from collections.abc import Iterator

import click


def manual(group: click.Group, ctx: click.Context, version: str) -> str:
    """Return the page of a group of commands in the language of troff."""
    name, short = str(group.name), (group.help or "").splitlines()[0].rstrip(".")
    lines = [
        f'.TH {name.upper()} 1 "" "{name} {version}" "{name} manual"',
        ".SH NAME",
        rf"{name} \- {_plain(short)}",
        ".SH SYNOPSIS",
        rf"\fB{name}\fR COMMAND ...",
        ".SH OPTIONS",
        *_options(group, ctx),
        ".SH COMMANDS",
        *_commands(group, ctx),
    ]
    return "\n".join(lines) + "\n"


def _commands(group: click.Group, ctx: click.Context) -> Iterator[str]:
    for name in group.list_commands(ctx):
        command = group.get_command(ctx, name)
        if command is None:
            continue
        inner = click.Context(command, info_name=name, parent=ctx)
        yield f'.SS "{_plain(inner.command_path)} {_plain(" ".join(command.collect_usage_pieces(inner)))}"'
        yield from _paragraphs(command.help or "")
        yield from _options(command, inner)
        yield from _paragraphs(command.epilog or "")
        if isinstance(command, click.Group):
            yield from _commands(command, inner)


def _options(command: click.Command, ctx: click.Context) -> Iterator[str]:
    records = (param.get_help_record(ctx) for param in command.get_params(ctx) if isinstance(param, click.Option))
    for flags, explained in filter(None, records):
        yield from (".TP", rf"\fB{_plain(flags)}\fR", _line(explained))


def _paragraphs(text: str) -> Iterator[str]:
    """Yield paragraphs, of which those that click leaves as they are, after a backspace, keep their lines."""
    for paragraph in inspect.cleandoc(text).split("\n\n"):
        as_it_is, lines = paragraph.startswith("\b\n"), paragraph.removeprefix("\b\n").splitlines()
        yield from (".PP", *([".nf"] if as_it_is else []), *map(_line, lines), *([".fi"] if as_it_is else []))


def _plain(text: str) -> str:
    """Return a text without what troff takes for its own."""
    return text.replace("\\", r"\e").replace("-", r"\-").replace('"', r"\(dq")


def _line(text: str) -> str:
    plain = _plain(text)
    return rf"\&{plain}" if plain.startswith((".", "'")) else plain
