# SPDX-License-Identifier: GPL-3.0-or-later
"""Click options generated from the settings, shown in groups."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import replace
from typing import Any, TypeVar

import click
from click.core import ParameterSource

from hdpea.cli.groups import GroupedOption, with_flags
from hdpea.cli.types import CountType, ParsedType, ShareType
from hdpea.options import Options
from hdpea.options.classes import Classes
from hdpea.options.lengths import Length
from hdpea.options.position import Position
from hdpea.options.settings import Setting, options_from, settings
from hdpea.options.upright import UP_AXES

Decorated = TypeVar("Decorated", bound=Callable[..., Any])


up_option = click.option(
    "--up",
    cls=GroupedOption,
    type=click.Choice(UP_AXES),
    help="axis that is up in a GLB, picture or page: z, y, or -y as before a depth camera; default: by the shape, "
    "z if it does not show",
)


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
    helps: Mapping[str, str] | None = None,
) -> Callable[[Decorated], Decorated]:
    """Add a flag for every setting of the given stages of the options `owner`, in their order.

    Settings `also` are added from whatever stage, those `without` are left out. The help lists them under the name
    of their stage, or all under `heading`, with the texts of `helps`, by setting, in place of their own.
    """
    helps = helps or {}
    known = [each for each in settings(owner) if each.name not in without]
    known = [replace(each, help=helps.get(each.name, each.help)) for each in known]
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
