# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands whose help lists options in groups, and whose errors name them as flags."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import click

from hdpea.errors import HdpeaError


class GroupedOption(click.Option):
    """An option listed under a heading of its own in the help."""

    def __init__(self, *args: Any, group: str = "General", **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.group = group


def with_flags(text: str, flags: Mapping[str, str]) -> str:
    """Return a text of the library with `flags`, by the names of options, where it names one of those.

    Examples
    --------
    >>> with_flags("Use `orient='auto'` or `refine=False`.", {"orient": "--orient", "refine": "--refine"})
    'Use --orient auto or --no-refine.'
    """

    def flag(found: re.Match[str]) -> str:
        name, value = found[1], found[2]
        if name not in flags:
            return found[0]
        if value in ("True", "False"):
            return flags[name] if value == "True" else f"--no-{flags[name][2:]}"
        return f"{flags[name]} {value.strip(chr(39))}" if value else flags[name]

    return _OPTION.sub(flag, text)


_OPTION = re.compile(r"`(\w+)(?:=([^`]*))?`")


class GroupedCommand(click.Command):
    """A command whose help lists the options group by group, in the order in which they were added.

    The library's errors name options as Python does; where they come from a command, they name its flags.
    """

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments; errors say of which command they are."""
        given = list(args)
        try:
            return super().parse_args(ctx, args)
        except click.UsageError as error:
            flags = {flag for param in self.params for flag in param.opts}
            typed = next((each for each in given if f"-{each}" in flags), None)
            if isinstance(error, click.NoSuchOption) and typed is not None:
                # It was read as many options of one letter.
                raise click.NoSuchOption(typed, possibilities=[f"-{typed}"], ctx=ctx) from error
            error.ctx = error.ctx or ctx
            raise

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command."""
        try:
            return super().invoke(ctx)
        except HdpeaError as error:
            error.message, error.hint = self.in_flags(error.message), self.in_flags(error.hint)
            raise

    def in_flags(self, text: str) -> str:
        """Return a text of the library with the flags of this command in place of options."""
        flags = {str(each.name): each.opts[0] for each in self.params if isinstance(each, click.Option)}
        return with_flags(text, flags)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write one section per group."""
        groups: dict[str, list[tuple[str, str]]] = {}
        for param in self.get_params(ctx):
            record = param.get_help_record(ctx)
            if record is not None and isinstance(param, click.Option):
                groups.setdefault(getattr(param, "group", "General"), []).append(record)
        for group, records in groups.items():
            with formatter.section(group):
                formatter.write_dl(records)


def in_flags(text: str) -> str:
    """Return a text of the library with the flags of the command that is running in place of options."""
    command = click.get_current_context().command
    return command.in_flags(text) if isinstance(command, GroupedCommand) else text
