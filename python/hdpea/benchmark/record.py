# SPDX-License-Identifier: GPL-3.0-or-later
"""The record of one run: a method on the points of a model, with a budget of vertices."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import Any

from hdpea.runtime.outputs import replacing

RMS = ("accuracy.longest_side.to_truth.rms", "accuracy.longest_side.to_result.rms")
"""Paths to the distance that is logged for a run: from the result, or if the truth is a point cloud, to the result."""

LARGEST = ("accuracy.longest_side.hausdorff", "accuracy.longest_side.to_result.max")
"""The same for the largest distance, in either direction or from the points."""


@dataclass(frozen=True)
class Record:
    """One run.

    Attributes
    ----------
    model, given, method
        Names of the model, the input and the method.
    vertices
        Number wanted.
    key
        Hash of everything that the mesh and its scores depend on; a run is done again when it changes.
    code
        The version and commit of hdpea that did the run.
    failed
        Why there is no mesh, as a sentence; empty if there is one.
    seconds, cpu_seconds, peak_bytes
        Cost of the method alone, after its libraries were loaded: elapsed time; CPU time of all cores, which depends
        less on the load of the machine; peak resident memory of its process.
    scores
        As ``Evaluation.as_dict``.
    """

    model: str
    given: str
    method: str
    vertices: int
    key: str
    code: str = ""
    failed: str = ""
    seconds: float = 0.0
    cpu_seconds: float = 0.0
    peak_bytes: int = 0
    scores: Mapping[str, Any] = field(default_factory=dict)

    def score(self, *paths: str) -> float | None:
        """Return the score at a path such as ``triangles.g``; of several paths, the first that exists; None without."""
        for path in paths:
            found: Any = self.scores
            for name in path.split("."):
                found = found.get(name) if isinstance(found, Mapping) else None
            if found is not None:
                return float(found)
        return None

    @property
    def stem(self) -> Path:
        """Relative path of the files of this run, without extension."""
        return Path(*map(file_name, (self.given, self.model, f"{self.method}@{self.vertices}")))


def file_name(name: str) -> str:
    """Return a name made safe as a part of a path."""
    return re.sub(r"[^\w.@%+-]+", "_", name)


def key_of(*what: Any) -> str:
    """Return a hash of anything that JSON can represent."""
    return sha256(json.dumps(what, sort_keys=True, default=str).encode()).hexdigest()


def write_record(path: Path, record: Record) -> None:
    """Write a record as JSON, whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with replacing(path) as partial:
        partial.write_text(json.dumps(asdict(record), indent=1) + "\n")


def read_record(path: Path) -> Record | None:
    """Read a record; None if there is none, or another version wrote it."""
    try:
        return Record(**json.loads(path.read_text()))
    except (OSError, ValueError, TypeError):
        return None
