# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups of commands that are imported only when asked for, so that help is instant."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from pathlib import Path

import click

from hdpea.errors import UsageError


def lazy_group(package: str, commands: Sequence[str]) -> type[click.Group]:
    """Return the class of a group whose commands are the ``command`` of each module of those names in `package`."""

    class LazyGroup(click.Group):
        def list_commands(self, _ctx: click.Context) -> list[str]:
            # The most important first, where click would sort them.
            return list(commands)

        def get_command(self, _ctx: click.Context, name: str) -> click.Command | None:
            if name not in commands:
                return None
            command: click.Command = import_module(f"{package}.{name}").command
            command.name = name
            return command

        def resolve_command(
            self, ctx: click.Context, args: list[str]
        ) -> tuple[str | None, click.Command | None, list[str]]:
            try:
                return super().resolve_command(ctx, args)
            except click.exceptions.NoSuchCommand as error:
                if Path(error.command_name).suffix:
                    reason = f"{error.command_name} is a file, where a command is expected: {', '.join(commands)}."
                    raise UsageError(reason, f"{ctx.command_path} {commands[0]} {' '.join(args)}") from error
                # The nearest of them is suggested, of which click knows only those that it has loaded.
                raise click.exceptions.NoSuchCommand(error.command_name, possibilities=commands, ctx=ctx) from error

    return LazyGroup
