# SPDX-License-Identifier: GPL-3.0-or-later
"""The options as one flat list of named settings: what flags, config files and the report are made from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from types import NoneType
from typing import Any, TypeVar, get_args, get_type_hints

from hdpea.options.checked import Checked
from hdpea.options.classes import Classes
from hdpea.options.lengths import Length
from hdpea.options.position import Position
from hdpea.options.reconstruction import Options

Chosen = TypeVar("Chosen", bound=Checked)

RUN = "run"
"""The stage of a setting that belongs to the run as a whole."""


@dataclass(frozen=True)
class Setting:
    """One field of one options dataclass.

    ``kind`` is the type of its value (int, float, bool, str, Length, Position or Classes); ``stage`` the field of
    the options it lies in, or ``RUN``.
    """

    name: str
    stage: str
    kind: type
    default: object
    help: str
    choices: tuple[str, ...] | None


def settings(owner: type[Any] = Options) -> list[Setting]:
    """Return every setting of the options class `owner`, stage by stage in the order of the run.

    Names are unique: a field that several stages have, such as a seed, is one setting for all of them.
    """
    unique: dict[str, Setting] = {}
    for each in _all(owner):
        unique.setdefault(each.name, each)
    return list(unique.values())


def _all(owner: type[Any]) -> Iterator[Setting]:
    for each in fields(owner):
        if is_dataclass(each.default):
            yield from _of(type(each.default), each.name)
    yield from _of(owner, RUN)


def _of(owner: type[Any], stage: str) -> Iterator[Setting]:
    hints = get_type_hints(owner)
    for each in fields(owner):
        if "help" in each.metadata:
            kinds = [kind for kind in get_args(hints[each.name]) or (hints[each.name],) if kind is not NoneType]
            yield Setting(each.name, stage, kinds[0], each.default, each.metadata["help"], each.metadata.get("choices"))


def options_from(values: Mapping[str, Any]) -> Options:
    """Return the options of a reconstruction, as ``filled`` does."""
    return filled(Options, values)


def filled(owner: type[Chosen], values: Mapping[str, Any]) -> Chosen:
    """Return the options of class `owner` with the given settings, and the defaults for the others.

    Raises
    ------
    UsageError
        If a value is illegal.
    """
    return changed(owner(), values)


def changed(options: Chosen, values: Mapping[str, Any]) -> Chosen:
    """Return `options` with the given settings in place of their own.

    Raises
    ------
    UsageError
        If a value is illegal.
    """
    given: dict[str, dict[str, Any]] = {}
    for each in _all(type(options)):
        if each.name in values:
            given.setdefault(each.stage, {})[each.name] = values[each.name]
    run = given.pop(RUN, {})
    stages = {stage: replace(getattr(options, stage), **chosen) for stage, chosen in given.items()}
    return replace(options, **stages, **run)


def as_dict(options: object) -> dict[str, dict[str, Any]]:
    """Return the settings by stage and name, lengths and positions as users write them; fit for JSON."""
    listed: dict[str, dict[str, Any]] = {}
    for each in _all(type(options)):
        owner = options if each.stage == RUN else getattr(options, each.stage)
        value = getattr(owner, each.name)
        listed.setdefault(each.stage, {})[each.name] = (
            str(value) if isinstance(value, Length | Position | Classes) else value
        )
    return listed
