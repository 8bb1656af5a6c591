# SPDX-License-Identifier: GPL-3.0-or-later
"""Options that check themselves: fields with a help text and what is legal."""

from __future__ import annotations

import math
from dataclasses import Field, dataclass, field, fields
from typing import Any

from hdpea.errors import UsageError


def option(default: Any, help: str, **metadata: Any) -> Any:
    """Return a dataclass field that carries its help text and what is legal: ``choices``, ``minimum``, ``maximum``."""
    return field(default=default, metadata={"help": help, **metadata})


LARGEST_COUNT = 2**31 - 1
"""Of counts, and whatever else the core holds in a number of 32 bits: their ``maximum``."""

LARGEST_WHOLE = 2**63 - 1
"""Of any whole number."""


def _check(field: Field[Any], value: Any) -> None:
    choices = field.metadata.get("choices")
    minimum, maximum = field.metadata.get("minimum"), field.metadata.get("maximum")
    if choices is not None and value not in choices:
        raise UsageError(f"`{field.name}` is one of {', '.join(choices)}, not {value!r}.")
    if isinstance(value, float) and not math.isfinite(value):
        raise UsageError(f"`{field.name}` is a number, not {value}.")
    if maximum is None and isinstance(value, int):
        maximum = LARGEST_WHOLE
    try:
        if minimum is not None and value is not None and not value >= minimum:
            raise UsageError(f"`{field.name}` is at least {minimum}, not {value}.")
        if maximum is not None and value is not None and not value <= maximum:
            raise UsageError(f"`{field.name}` is at most {maximum}, not {value}.")
    except TypeError as error:
        raise UsageError(f"`{field.name}` is a number, not {value!r}.") from error


@dataclass(frozen=True)
class Checked:
    """Base of the options: checks every value against its field's choices, minimum and maximum."""

    def __post_init__(self) -> None:
        for each in fields(self):
            _check(each, getattr(self, each.name))
