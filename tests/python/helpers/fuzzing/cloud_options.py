# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of a reconstruction, at random: mostly legal, and cheap enough for a small cloud."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from hdpea.options import Length, Position
from hdpea.options.settings import Setting, settings

Random = np.random.Generator

OFTEN = {
    "outliers": 0.9,
    "vertices": 0.35,
    "faces": 0.15,
    "watertight": 0.3,
    "denoise": 0.3,
    "orient": 0.3,
    "min_component": 0.2,
}
"""How often a setting is given; the others are in one case of twelve."""

MOST = {"iterations": 20, "rounds": 4, "threads": 3, "normal_neighbors": 80, "denoise_neighbors": 120, "lod": 4}
"""Whole numbers are mostly drawn up to these, or up to half the number of points."""


LEAST = {
    "vertices": 4,
    "faces": 4,
    "particles": 4,
    "normal_neighbors": 3,
    "denoise_neighbors": 6,
    "whole_points": 1,
    "max_stretch": 1,
    "lod": 1,
}


def settings_at_random(random: Random, points: int) -> dict[str, Any]:
    """Return settings by name for a cloud of so many points; threads are always given."""
    given = {
        each.name: _value(random, each, points)
        for each in settings()
        if each.name not in {"weights", "device", "classes", "texture"} and random.random() < OFTEN.get(each.name, 0.08)
    }
    if "vertices" in given and random.random() < 0.95:
        given.pop("faces", None)
    if "particles" in given and random.random() < 0.8:
        given = {name: value for name, value in given.items() if name not in {"vertices", "faces"}}
    if "viewpoint" in given and random.random() < 0.9:
        given["orient"] = "viewpoint"
    return {"threads": 1} | given


def _value(random: Random, setting: Setting, points: int) -> Any:
    if setting.choices:
        return str(random.choice(setting.choices))
    least = LEAST.get(setting.name, 0)
    at_random: dict[type, Callable[[], Any]] = {
        bool: lambda: bool(random.random() < 0.7),
        int: lambda: least + _whole_number(random, setting, points),
        float: lambda: least + _number(random),
        Length: lambda: Length(0.0 if random.random() < 0.1 else _number(random), bool(random.random() < 0.7)),
        Position: lambda: Position(*(random.normal(size=3) * _number(random)).tolist()),
    }
    return at_random[setting.kind]()


def _whole_number(random: Random, setting: Setting, points: int) -> int:
    if random.random() < 0.03 and setting.name not in {"iterations", "rounds"}:
        return int(random.choice([-9, 2**31 - 9, 2**62]))
    return int(random.integers(0, MOST.get(setting.name, max(points // 2, 5)) + 1))


def _number(random: Random) -> float:
    """Return a positive number: mostly of the order of 1, sometimes of any order."""
    return float(10.0 ** (random.uniform(-300, 300) if random.random() < 0.1 else random.uniform(-2, 2)))
