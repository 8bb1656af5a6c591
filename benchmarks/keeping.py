# SPDX-License-Identifier: GPL-3.0-or-later
"""What was measured is kept, mesh by mesh: a long table can be made in pieces, and goes on where it was stopped."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from hdpea.runtime.outputs import replacing

Kept = TypeVar("Kept")


def kept(folder: Path | None, name: str, measure: Callable[[], Kept]) -> Kept:
    """Return what `folder` keeps under this name, or else measure it and keep it, as JSON."""
    if folder is None:
        return measure()
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.json"
    if not path.exists():
        with replacing(path) as partial:
            partial.write_text(json.dumps(measure(), indent=1))
    result: Kept = json.loads(path.read_text())
    return result
