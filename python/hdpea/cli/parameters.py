# SPDX-License-Identifier: GPL-3.0-or-later
"""Click options generated from the settings, shown in groups."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any, TypeVar

import click
from click.core import ParameterSource

from hdpea.errors import HdpeaError
from hdpea.options import Options
from hdpea.options.classes import Classes
from hdpea.options.lengths import Length
from hdpea.options.position import Position
from hdpea.options.settings import Setting, options_from, settings
from hdpea.options.upright import UP_AXES

Decorated = TypeVar("Decorated", bound=Callable[..., Any])


class ParsedType(click.ParamType[Any]):
    """Text that its class can ``parse``: a length such as ``1%``, a position such as ``1,2,3``, classes as ``2,6``."""

    def __init__(self, kind: type[Length] | type[Position] | type[Classes]) -> None:
        self.kind = kind
        self.name = kind.__name__.lower()

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Length | Position | Classes:
        """Return the value; a usage error if it is none."""
        try:
            return value if isinstance(value, self.kind) else self.kind.parse(value)
        except ValueError as error:
            self.fail(f"{error}.", param, ctx)


class ShareType(click.ParamType[float]):
    """A number such as ``0.003``, which many prefer to write as ``0.3%`` where it is a share."""

    name = "float"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number; a usage error if it is none."""
        text = str(value).strip()
        try:
            return float(text.removesuffix("%")) / 100 if text.endswith("%") else float(text)
        except ValueError:
            self.fail(f"{text!r} is not a number such as 0.003 or 0.3%.", param, ctx)


class CountType(click.ParamType[int]):
    """A whole number, without separators: whether ``5,000`` is five thousand depends on where one lives."""

    name = "integer"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Return the number; a usage error if it is none."""
        try:
            return int(value)
        except ValueError:
            grouped = re.fullmatch(r"\d{1,3}([ ,.']\d{3})+", str(value).strip())
            example = re.sub(r"\D", "", grouped[0]) if grouped else "5000"
            self.fail(f"{value!r} is not a whole number such as {example}.", param, ctx)


class PathType(click.Path):
    """The name of a file or folder, be there one or not; what no file can be called is a usage error."""

    def __init__(self) -> None:
        super().__init__(path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path."""
        if not str(value):
            self.fail("a name is missing; in a script, see that its variable is set.", param, ctx)
        path = super().convert(value, param, ctx)
        try:
            Path(value).exists()
        except OSError as error:
            self.fail(f"{value}: {error.strerror}.", param, ctx)
        return path


PATH = PathType()


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


up_option = click.option(
    "--up",
    cls=GroupedOption,
    type=click.Choice(UP_AXES),
    help="axis that is up in a GLB, picture or page: z, y, or -y as before a depth camera; default: by the shape, "
    "z if it does not show",
)


def in_flags(text: str) -> str:
    """Return a text of the library with the flags of the command that is running in place of options."""
    command = click.get_current_context().command
    return command.in_flags(text) if isinstance(command, GroupedCommand) else text


quiet_option = click.option("--quiet", cls=GroupedOption, is_flag=True, help="say nothing but errors")


force_option = click.option(
    "--force", cls=GroupedOption, is_flag=True, help="replace files that hdpea did not make, though never an input"
)


def setting_options(
    *stages: str,
    also: Collection[str] = (),
    without: Collection[str] = (),
    owner: type[Any] = Options,
    heading: str | None = None,
) -> Callable[[Decorated], Decorated]:
    """Add a flag for every setting of the given stages of the options `owner`, in their order.

    Settings `also` are added from whatever stage, those `without` are left out. The help lists them under the name
    of their stage, or all under `heading`.
    """
    known = [each for each in settings(owner) if each.name not in without]
    flags = {each.name: _flag_of(each) for each in known}
    chosen = [each for each in known if each.name in also]
    chosen += [each for stage in stages for each in known if each.stage == stage and each.name not in also]

    def decorate(function: Decorated) -> Decorated:
        # Decorators work from the last to the first.
        for each in reversed(chosen):
            function = _flag(each, flags, heading or each.stage.replace("_", " ").capitalize())(function)
        return function

    return decorate


def _flag_of(setting: Setting) -> str:
    return "--" + setting.name.replace("_", "-")


def _flag(setting: Setting, flags: Mapping[str, str], group: str) -> Callable[[Decorated], Decorated]:
    flag = flags[setting.name]
    kinds: dict[type, Any] = {
        Length: ParsedType(Length),
        Position: ParsedType(Position),
        Classes: ParsedType(Classes),
        float: ShareType(),
        int: CountType(),
    }
    return click.option(
        f"{flag}/--no-{flag[2:]}" if setting.kind is bool else flag,
        cls=GroupedOption,
        group=group,
        type=click.Choice(setting.choices) if setting.choices else kinds.get(setting.kind, setting.kind),
        default=setting.default,
        show_default=setting.default is not None,
        help=with_flags(setting.help, flags),
    )


def chosen_options(ctx: click.Context, values: Mapping[str, Any]) -> Options:
    """Return the options for the values that click gave.

    Raises
    ------
    UsageError
        If a value, or the combination, is illegal.
    """
    chosen = dict(values)
    # A flag wins over the config file, which for these two means that it rules out the other.
    for flag, other in (("vertices", "faces"), ("faces", "vertices")):
        if (ctx.get_parameter_source(flag), ctx.get_parameter_source(other)) == (
            ParameterSource.COMMANDLINE,
            ParameterSource.DEFAULT_MAP,
        ):
            del chosen[other]
    return options_from(chosen)
