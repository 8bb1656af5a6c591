# SPDX-License-Identifier: GPL-3.0-or-later
"""Values that were chosen because none was given."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Choice:
    """A value that hdpea chose because nobody gave one, and why it is what it is."""

    name: str
    value: float | int | str
    unit: str
    why: str
