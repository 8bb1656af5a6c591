# SPDX-License-Identifier: GPL-3.0-or-later
"""Measurements stored mesh by mesh, so that a long table can be made in several runs."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from hdpea.runtime.outputs import replacing

Kept = TypeVar("Kept")


def kept(folder: Path | None, name: str, measure: Callable[[], Kept]) -> Kept:
    """Return the value stored in `folder` under this name, or measure it and store it, as JSON."""
    if folder is None:
        return measure()
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.json"
    if not path.exists():
        with replacing(path) as partial:
            partial.write_text(json.dumps(measure(), indent=1))
    result: Kept = json.loads(path.read_text())
    return result
