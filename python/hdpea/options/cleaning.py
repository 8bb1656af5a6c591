# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the front end."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.options.checked import Checked, option
from hdpea.options.classes import Classes


@dataclass(frozen=True)
class CleaningOptions(Checked):
    """Which points of a raw cloud are taken for the surface (``hdpea.frontend``)."""

    outliers: str = option(
        "auto",
        "auto: drop points that lie on no surface, and those that crowd on scan lines; none: keep all points",
        choices=("auto", "none"),
    )
    classes: Classes | None = option(None, "take only the points of these classes, as 2,6; default: all points")
