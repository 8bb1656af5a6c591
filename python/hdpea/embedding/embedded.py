# SPDX-License-Identifier: GPL-3.0-or-later
"""What an embedder returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.metric import Metric
from hdpea.options.choice import Choice


@dataclass(frozen=True)
class Embedded:
    """Coordinates of a surface in R^8.

    Attributes
    ----------
    coordinates
        (n, 8) float64: the points in the unit frame, then psi.
    choices
        The lengths that were chosen automatically, in world units.
    metric
        Distances in R^8 are lengths under it; None if the embedder does not know it, and then no curvature can be
        derived from them.
    """

    coordinates: NDArray[np.float64]
    choices: tuple[Choice, ...] = ()
    metric: Metric | None = None
