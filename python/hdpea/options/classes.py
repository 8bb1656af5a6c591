# SPDX-License-Identifier: GPL-3.0-or-later
"""Classes of points as users give them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from hdpea.errors import UsageError


@dataclass(frozen=True)
class Classes:
    """Numbers of classes, such as those of LAS: 2 is ground, 6 a building.

    Raises
    ------
    ValueError
        If there are none.
    """

    numbers: tuple[int, ...]

    def __post_init__(self) -> None:
        if not self.numbers:
            raise ValueError("no classes are no points")

    @classmethod
    def parse(cls, text: str) -> Classes:
        """Read ``2,6``; ValueError if it is no list of whole numbers."""
        try:
            return cls(tuple(int(number) for number in text.split(",")))
        except ValueError:
            raise ValueError(f"{text!r} is not a list of classes such as 2,6") from None

    @classmethod
    def of(cls, classes: Classes | str | int | Iterable[int]) -> Classes:
        """Take classes, a number, several, or text as ``parse`` reads it.

        Raises
        ------
        UsageError
            If it is none of these.
        """
        if isinstance(classes, Classes):
            return classes
        try:
            listed = [classes] if isinstance(classes, str | int) else list(classes)
            return cls.parse(",".join(map(str, listed)))
        except (TypeError, ValueError) as error:
            raise UsageError(f"`classes` are whole numbers, such as 2,6, not {classes!r}.") from error

    def __str__(self) -> str:
        return ",".join(map(str, self.numbers))
