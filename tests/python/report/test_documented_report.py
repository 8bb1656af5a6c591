# SPDX-License-Identifier: GPL-3.0-or-later
"""Every key of a report is explained in docs/report.md."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from helpers import clouds

from hdpea import reconstruct
from hdpea.cli.ended import Ended
from hdpea.options import Options
from hdpea.options.settings import changed

PAGE = (Path(__file__).parents[3] / "docs/report.md").read_text()
EXPLAINED = set(re.findall(r"`([\w-]+)`", PAGE))


def keys_of(value: Any) -> Iterator[str]:
    """Yield the keys of a report at any depth, and what its choices and stages are called."""
    if isinstance(value, list):
        for each in value:
            yield from keys_of(each)
    elif isinstance(value, dict):
        yield from value
        if {"name", "why"} <= set(value) or {"name", "seconds"} <= set(value):
            yield value["name"]
        for each in value.values():
            yield from keys_of(each)


def test_every_key_of_a_report_is_explained() -> None:
    points, _ = clouds.sphere(600)
    grey = np.full(len(points), 7.0)
    options = changed(Options(), {"lod": 2})
    made = reconstruct(points, options=options, vertices=40, attributes={"intensity": grey})
    report = made.report.as_json()
    assert {"edges_collapsed", "pieces_turned"} <= set(report["meshing"]), "the report of a run that does it all"
    report.pop("options")  # which the page of the command explains
    assert set(keys_of(report)) <= EXPLAINED


def test_every_key_of_a_line_of_json_is_explained() -> None:
    section = PAGE.split("## A line of JSON")[1]
    assert all(f"`{key}`" in section for key in json.loads(Ended(("a.ply",), "a.mesh.ply").as_line()))
