# SPDX-License-Identifier: GPL-3.0-or-later
"""What the arguments of commands are: lengths, shares, counts, paths."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import click

from hdpea.options.classes import Classes
from hdpea.options.lengths import Length
from hdpea.options.position import Position


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
