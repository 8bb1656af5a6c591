# SPDX-License-Identifier: GPL-3.0-or-later
"""Which method is the nearest to the truth on which model: means hide on how many of them a method loses."""

from __future__ import annotations

from collections.abc import Sequence

from hdpea.benchmark.record import Record
from hdpea.benchmark.suite import Suite

NAMED = 8
"""Models that are named; of more, the number is told."""


def nearest_sentence(records: Sequence[Record], suite: Suite, given: str, vertices: int) -> str:
    """Return who has the smallest exact chamfer distance on which models; empty unless several made a mesh of one.

    Of equals, the first in the suite is named.
    """
    path = f"accuracy.{suite.options.normalization}.chamfer"
    here = [each for each in records if (each.given, each.vertices) == (given, vertices)]
    won: dict[str, list[str]] = {}
    several = False
    for model in dict.fromkeys(each.model for each in here):
        scores = {each.method: each.score(path) for each in here if each.model == model}
        known = {name: score for name, score in scores.items() if score is not None}
        several |= len(known) > 1
        if known:
            won.setdefault(min(known, key=known.__getitem__), []).append(model)
    if not several:
        return ""
    by_method = [f"{method.name} on {_models(won[method.name])}" for method in suite.methods if method.name in won]
    return f"Smallest exact CD: {'; '.join(by_method)}."


def _models(names: Sequence[str]) -> str:
    return f"{len(names)} models" if len(names) > NAMED else ", ".join(names)
