# SPDX-License-Identifier: GPL-3.0-or-later
"""A file that samples or benchmark models are made from, with its origin and licence."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

UNSTATED = "unstated"
"""Origin or licence of a file that nobody states."""


@dataclass(frozen=True)
class Source:
    """The file of a mesh or a point cloud.

    Attributes
    ----------
    name
        Unique among the files of a dataset or suite.
    source
        Path relative to the folder in which it was found, or ``thingi10k:ID``.
    path
        Where the file is on this machine.
    origin, licence
        Where it comes from, and its terms of use.
    """

    name: str
    source: str
    path: Path
    origin: str = UNSTATED
    licence: str = UNSTATED

    def sha256(self) -> str | None:
        """Return the SHA-256 of the file; None if it cannot be read."""
        try:
            return sha256(self.path.read_bytes()).hexdigest()
        except OSError:
            return None
