# SPDX-License-Identifier: GPL-3.0-or-later
"""The config file: the settings of a run, by the names of their flags, in TOML."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path
from typing import Any

import click

from hdpea.cli.groups import GroupedOption
from hdpea.cli.types import PATH
from hdpea.errors import UsageError
from hdpea.options.settings import settings

_USED = "hdpea.config"


def read_config(path: Path) -> dict[str, Any]:
    """Return the settings in a TOML file by name; ``fill-holes`` and ``fill_holes`` are the same.

    Raises
    ------
    UsageError
        If the file cannot be read, is no TOML, or has a key that is no setting.
    """
    import tomllib

    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise UsageError(f"Cannot read {path}: {error.strerror}.", "Check the name and the permissions.") from error
    except (ValueError, RecursionError) as error:
        what = "its values are nested too deep" if isinstance(error, RecursionError) else error
        raise UsageError(f"{path} is not a TOML file: {what}.", "Lines look like: vertices = 5000") from error
    names = [each.name for each in settings()]
    given = {}
    for key, value in content.items():
        name = key.replace("-", "_")
        if isinstance(value, dict):
            raise UsageError(f"{path} has a table [{key}].", "Keys are the names of flags, without tables.")
        if name not in names:
            near = get_close_matches(name, names, 1, cutoff=0)
            raise UsageError(f"{path} has an unknown key {key!r}.", f"The nearest known key is {near[0]!r}.")
        given[name] = value if isinstance(value, bool) else _as_flag(key, value, path)
    return given


def _as_flag(key: str, value: object, path: Path) -> str:
    """Return a value as the command line has it, so that both are understood by the same rules."""
    try:
        return str(value)
    except (ValueError, RecursionError) as error:  # a whole number of more than 4,300 digits, or a list of lists
        raise UsageError(f"The value of {key!r} in {path} is not a setting's.", "Such as: vertices = 5000") from error


def _use_config(ctx: click.Context, _: click.Parameter, path: Path | None) -> None:
    if path is not None:
        ctx.default_map = read_config(path)
        ctx.meta[_USED] = path


def config_of(ctx: click.Context) -> Path | None:
    """Return the config file that the command was given, if any."""
    path: Path | None = ctx.meta.get(_USED)
    return path


config_option = click.option(
    "--config",
    cls=GroupedOption,
    type=PATH,
    is_eager=True,
    expose_value=False,
    callback=_use_config,
    help="TOML file of settings by the names of their flags; flags win over it",
)
