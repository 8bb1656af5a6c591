# SPDX-License-Identifier: GPL-3.0-or-later
"""Which method has the smallest error on which models, which means do not show."""

from __future__ import annotations

from collections.abc import Sequence

from hdpea.benchmark.record import Record
from hdpea.benchmark.suite import Suite

NAMED = 8
"""Most models that are named; of more, only the number is given."""

ERRORS = {"exact CD": "chamfer", "exact HD": "hausdorff"}
"""Errors that are compared: title, and path to the score."""

ERRORS_OF_POINTS = {"exact rms": "to_result.rms", "CD": "samples.chamfer"}
"""The same where the truth is a point cloud, to which there are no exact distances from the result."""


def winner_sentences(records: Sequence[Record], suite: Suite, given: str, vertices: int) -> str:
    """Return sentences on which method has the smallest errors on which models; empty unless two methods finished.

    Among equals, the first in the suite is named.
    """
    here = [each for each in records if (each.given, each.vertices) == (given, vertices) and not each.failed]
    if len({each.method for each in here}) < 2:
        return ""
    for errors in (ERRORS, ERRORS_OF_POINTS):
        won = {title: _won(here, f"accuracy.{suite.options.normalization}.{name}") for title, name in errors.items()}
        if any(won.values()):
            return " ".join(_sentence(title, suite, by_method) for title, by_method in won.items())
    return ""


def _sentence(title: str, suite: Suite, won: dict[str, list[str]]) -> str:
    by_method = [f"{method.name} on {_models(won[method.name])}" for method in suite.methods if method.name in won]
    return f"Smallest {title}: {'; '.join(by_method)}."


def _won(records: Sequence[Record], path: str) -> dict[str, list[str]]:
    """Return the models on which each method has the smallest score."""
    won: dict[str, list[str]] = {}
    for model in dict.fromkeys(each.model for each in records):
        scores = {each.method: each.score(path) for each in records if each.model == model}
        known = {name: score for name, score in scores.items() if score is not None}
        if known:
            won.setdefault(min(known, key=known.__getitem__), []).append(model)
    return won


def _models(names: Sequence[str]) -> str:
    return f"{len(names)} models" if len(names) > NAMED else ", ".join(names)
