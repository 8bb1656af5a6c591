# SPDX-License-Identifier: GPL-3.0-or-later
"""The work folder: what tasks have found, each in a file that is there whole or not at all."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.runtime.outputs import replacing

Arrays = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class WorkFolder:
    """Arrays and facts by the name of what found them, and by tile."""

    path: Path

    def file(self, name: str, tile: int | None = None) -> Path:
        """Return where something is kept."""
        return self.path / (f"{name}.npz" if tile is None else f"{name}.{tile}.npz")

    def has(self, name: str, tile: int | None = None) -> bool:
        """Return whether it is there."""
        return self.file(name, tile).exists()

    def save(
        self, name: str, tile: int | None, arrays: Mapping[str, ArrayLike], facts: Mapping[str, Any] | None = None
    ) -> None:
        """Keep arrays, and facts fit for JSON.

        Raises
        ------
        UsageError
            If the disk refuses.
        """
        text = np.frombuffer(json.dumps(facts or {}).encode(), dtype=np.uint8)
        with replacing(self.file(name, tile)) as partial:
            np.savez(partial, **{**arrays, "facts": text})  # type: ignore[arg-type]

    def load(self, name: str, tile: int | None = None) -> Arrays:
        """Return the arrays."""
        with np.load(self.file(name, tile)) as kept:
            return {each: kept[each] for each in kept.files if each != "facts"}

    def facts(self, name: str, tile: int | None = None) -> dict[str, Any]:
        """Return the facts."""
        with np.load(self.file(name, tile)) as kept:
            found: dict[str, Any] = json.loads(kept["facts"].tobytes())
        return found
