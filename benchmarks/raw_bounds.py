# SPDX-License-Identifier: GPL-3.0-or-later
"""What meshes of raw clouds are held to, next to those of a plain pipeline on the same clouds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

Row = dict[str, Any]

RMS_SHARE = {"strays": 0.35, "views": 0.5, "rings": 0.5}
"""Largest mean distance, as a share of the plain pipeline's."""

WRONG_SIDE = {"strays": 0.3, "views": 0.8, "rings": 0.3}
"""Largest mean share of the area that faces the wrong way, in percent; the median of views is held to 0.3."""


@dataclass(frozen=True)
class Bound:
    """A measurement, and what it may be at most; NaN where there is nothing to measure."""

    name: str
    measured: float
    most: float

    @property
    def verdict(self) -> str:
        """Whether the bound holds."""
        return "yes" if self.measured <= self.most else "NO"


def bounds_of(kind: str, ours: Sequence[Row], plain: Sequence[Row]) -> list[Bound]:
    """Return the bounds of a kind of clouds for its runs; means are over the meshes that both methods made."""
    made_by_plain = {row["mesh"]: row for row in plain if "nV" in row}
    pairs = [(row, made_by_plain[row["mesh"]]) for row in ours if "nV" in row and row["mesh"] in made_by_plain]

    def over(name: str, side: int, summary: Callable[[list[float]], Any] = np.mean) -> float:
        return float(summary([pair[side][name] for pair in pairs])) if pairs else float("nan")

    bounds = [
        Bound("runs with another exit code than 0", sum(str(row["exit"]) != "0" for row in ours), 0),
        Bound("meshes with more vertices than the plain one", sum(one["nV"] > two["nV"] for one, two in pairs), 0),
        Bound("debris, mean, %", 100 * over("debris", 0), 0.1),
        Bound("faces that cut others, mean, %", 100 * over("selfx", 0), 0.1),
        Bound("missed, mean, %", 100 * over("missed", 0), 100 * over("missed", 1) + 0.1),
        Bound("wrong side, mean, %", 100 * over("wrong", 0), WRONG_SIDE[kind]),
        Bound("rms, share of the plain one", over("rms", 0) / over("rms", 1), RMS_SHARE[kind]),
    ]
    if kind == "views":
        bounds.append(Bound("wrong side, median, %", 100 * over("wrong", 0, np.median), 0.3))
    return bounds
