# SPDX-License-Identifier: GPL-3.0-or-later
"""The two units of length that published scores are in."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Normalization:
    """The length of the true surface's bounding box that is the unit, and the distance threshold of F1 in it.

    Attributes
    ----------
    name
        Key in the JSON report.
    title
        Heading in tables.
    f1_threshold
        Distance below which F1 counts a point as matched, in that unit.
    """

    name: str
    title: str
    f1_threshold: float


LONGEST_SIDE = Normalization("longest_side", "longest side = 1", 0.003)
"""As NDC (Chen et al., 2022) and PoNQ (Maruani et al., 2024)."""

DIAGONAL = Normalization("diagonal", "diagonal = 1", 0.004)
"""As NASM (Li et al., 2024)."""

NORMALIZATIONS = (LONGEST_SIDE, DIAGONAL)
