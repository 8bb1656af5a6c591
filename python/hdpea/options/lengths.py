# SPDX-License-Identifier: GPL-3.0-or-later
"""Lengths as users give them: absolute, or a share of the size of the cloud."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hdpea.errors import UsageError


@dataclass(frozen=True)
class Length:
    """A length in world units, or in percent of the bounding-box diagonal.

    Parameters
    ----------
    value
        Finite and not negative; 0 usually disables what it measures.
    percent
        Whether `value` is a percentage of the diagonal.

    Raises
    ------
    ValueError
        If `value` is negative or not finite.
    """

    value: float
    percent: bool = False

    def __post_init__(self) -> None:
        if not (math.isfinite(self.value) and self.value >= 0):
            raise ValueError(f"a length cannot be {self.value:g}: it is finite and at least 0")

    @classmethod
    def parse(cls, text: str) -> Length:
        """Read ``0.02`` (world units) or ``1%`` (of the diagonal); ValueError if it is neither."""
        number = text.strip()
        percent = number.endswith("%")
        try:
            value = float(number.removesuffix("%"))
        except ValueError:
            raise ValueError(f"{text!r} is not a length such as 0.02 or 1%") from None
        return cls(value, percent)

    @classmethod
    def of(cls, length: Length | str | float) -> Length:
        """Take a length, a number in world units, or text as ``parse`` reads it.

        Raises
        ------
        UsageError
            If it is none of these.
        """
        try:
            return length if isinstance(length, Length) else cls.parse(str(length))
        except ValueError as error:
            raise UsageError(f"{error}.") from error

    def resolve(self, diagonal: float) -> float:
        """Return the length in the units of `diagonal`, the bounding-box diagonal of the cloud."""
        return self.value * diagonal / 100 if self.percent else self.value

    def __str__(self) -> str:
        number = repr(self.value).removesuffix(".0")
        return f"{number}%" if self.percent else number
