# SPDX-License-Identifier: GPL-3.0-or-later
"""What an embedder returns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.options.choice import Choice


@dataclass(frozen=True)
class Metric:
    """How much curvature stretches lengths: s^2 = clamp(c |k|, 1, s_max^2) along each principal direction.

    Attributes
    ----------
    scale
        c, a length in the unit frame, > 0.
    max_stretch
        s_max, at least 1.
    """

    scale: float
    max_stretch: float

    @property
    def curvature_range(self) -> tuple[float, float]:
        """The |k| between which the metric changes with curvature, in 1 / unit length."""
        return 1 / self.scale, self.max_stretch**2 / self.scale

    def stretches(self, curvatures: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the stretches of curvatures in 1 / unit length, of any sign and shape."""
        return np.asarray(np.sqrt(np.clip(self.scale * np.abs(curvatures), 1, self.max_stretch**2)))

    def curvatures(self, stretches: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the |k| of stretches in 1 / unit length; at an end of the range it may be less, or more."""
        return np.asarray(np.clip(stretches**2, 1, self.max_stretch**2) / self.scale)


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
        Under which distances in R^8 are lengths; None if the embedder does not know, and then no curvature
        can be told from them.
    """

    coordinates: NDArray[np.float64]
    choices: tuple[Choice, ...] = ()
    metric: Metric | None = None
