# SPDX-License-Identifier: GPL-3.0-or-later
"""The options as one flat list of named settings: what flags, config files and the report are made from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
from types import NoneType
from typing import Any, get_args, get_type_hints

from hdpea.lengths import Length
from hdpea.options import Options
from hdpea.position import Position

RUN = "run"
"""The stage of a setting that belongs to the run as a whole."""


@dataclass(frozen=True)
class Setting:
    """One field of one options dataclass.

    ``kind`` is the type of its value (int, float, bool, str, Length or Position); ``stage`` the field of
    ``Options`` it lies in, or ``RUN``.
    """

    name: str
    stage: str
    kind: type
    default: object
    help: str
    choices: tuple[str, ...] | None


def settings() -> list[Setting]:
    """Return every setting, stage by stage in the order of the run; names are unique."""
    nested = {each.name: type(each.default) for each in fields(Options) if is_dataclass(each.default)}
    return [each for stage, owner in nested.items() for each in _of(owner, stage)] + list(_of(Options, RUN))


def _of(owner: type[Any], stage: str) -> Iterator[Setting]:
    hints = get_type_hints(owner)
    for each in fields(owner):
        if "help" in each.metadata:
            kinds = [kind for kind in get_args(hints[each.name]) or (hints[each.name],) if kind is not NoneType]
            yield Setting(each.name, stage, kinds[0], each.default, each.metadata["help"], each.metadata.get("choices"))


def options_from(values: Mapping[str, Any]) -> Options:
    """Return the options with the given settings, and the defaults for the others.

    Raises
    ------
    UsageError
        If a value is illegal.
    """
    given: dict[str, dict[str, Any]] = {}
    for each in settings():
        if each.name in values:
            given.setdefault(each.stage, {})[each.name] = values[each.name]
    run = given.pop(RUN, {})
    return Options(**{stage: type(getattr(Options, stage))(**chosen) for stage, chosen in given.items()}, **run)


def as_dict(options: Options) -> dict[str, dict[str, Any]]:
    """Return the settings by stage and name, lengths and positions as users write them; fit for JSON."""
    listed: dict[str, dict[str, Any]] = {}
    for each in settings():
        owner = options if each.stage == RUN else getattr(options, each.stage)
        value = getattr(owner, each.name)
        listed.setdefault(each.stage, {})[each.name] = str(value) if isinstance(value, Length | Position) else value
    return listed
