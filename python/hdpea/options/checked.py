# SPDX-License-Identifier: GPL-3.0-or-later
"""Options that check themselves: fields with a help text and what is legal."""

from __future__ import annotations

import math
from dataclasses import Field, dataclass, field, fields
from typing import Any

from hdpea.errors import UsageError

LARGEST = 2**63 - 1
"""Of whole numbers, unless an option says otherwise: the core holds no larger ones."""


def option(default: Any, help: str, **metadata: Any) -> Any:
    """Return a dataclass field that carries its help text and what is legal: ``choices``, ``minimum``, ``maximum``."""
    return field(default=default, metadata={"help": help, **metadata})


def _check(field: Field[Any], value: Any) -> None:
    if value is None:
        return
    choices = field.metadata.get("choices")
    whole, number = field.type in {"int", "int | None"}, field.type in {"float", "float | None"}
    minimum, maximum = field.metadata.get("minimum"), field.metadata.get("maximum", LARGEST if whole else None)
    if whole and not hasattr(value, "__index__"):
        raise UsageError(f"`{field.name}` is a whole number, not {value!r}.")
    if number and not hasattr(value, "__float__"):
        raise UsageError(f"`{field.name}` is a number, not {value!r}.")
    if choices is not None and value not in choices:
        raise UsageError(f"`{field.name}` is one of {', '.join(choices)}, not {value!r}.")
    if isinstance(value, float) and not math.isfinite(value):
        raise UsageError(f"`{field.name}` is a number, not {value}.")
    if minimum is not None and not value >= minimum:
        raise UsageError(f"`{field.name}` is at least {minimum}, not {value}.")
    if maximum is not None and not value <= maximum:
        raise UsageError(f"`{field.name}` is at most {maximum}, not {value}.")


@dataclass(frozen=True)
class Checked:
    """Base of the options: checks every value against its field's choices, minimum and maximum."""

    def __post_init__(self) -> None:
        for each in fields(self):
            _check(each, getattr(self, each.name))
