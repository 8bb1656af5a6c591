# SPDX-License-Identifier: GPL-3.0-or-later
"""How rough a cloud is, measured on the points alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.frontend.patches import PLANE, QUADRIC, Patches, deviation
from hdpea.geometry.thinning import rows_along

SAMPLES = 2_000
"""Points at which it is measured: their median is certain to a few percent."""

NEIGHBORS = 24
"""Points that a quadratic surface, of six unknowns, is fitted to."""

CLEANEST = 0.25
"""Quantile of the residuals that is reported: noise is everywhere, creases are not."""

SPREAD = 0.525
"""Least half-width of the shortest half of a plane's residuals, in standard deviations, that is noise: 0.54 to 0.55
measured.

The residuals of two sheets, as of thin walls, lie nearer to their two heights (``benchmarks/roughness_table.py``)."""

SATURATED, LEAST_SHARE = 0.94, 0.25
"""Residual of a quadric, in spacings, that no noise exceeds, and the least share of the noise that it can be.

Seen by few neighbours, a thick shell is a solid ball. Corrected, noise of up to 1.5 spacings is measured to 15 %.
"""


@dataclass(frozen=True)
class Roughness:
    """How far points are off a smooth surface, and whether that is noise.

    Attributes
    ----------
    deviation
        Standard deviation across the surface, in spacings of the points (a spacing is the square root of the area per
        point): the residual of quadratic surfaces, so that curvature does not count.
    like_noise
        Whether it is distributed like noise. The two sides of thin walls are not, nor are misaligned scans.
    """

    deviation: float
    like_noise: bool

    @property
    def noise(self) -> float:
        """The deviation if it is noise, else 0."""
        return self.deviation if self.like_noise else 0.0

    def __str__(self) -> str:
        """Say how far, in spacings."""
        return f"the points are {self.deviation:.2g} spacings off a smooth surface"


def roughness_of(points: NDArray[np.float64]) -> Roughness:
    """Return how rough points (n, 3) are: not at all for under 24."""
    count = len(points)
    if count < NEIGHBORS:
        return Roughness(0.0, False)
    patches = Patches.around(points, rows_along(count, SAMPLES), NEIGHBORS)
    residuals = patches.residuals(PLANE)
    spread = float(np.median(_shortest_half(residuals) / deviation(residuals, PLANE)))
    deviations = deviation(patches.residuals(QUADRIC), QUADRIC) * np.sqrt(NEIGHBORS / np.pi)
    seen = float(np.quantile(deviations, CLEANEST))
    return Roughness(seen / max(1 - (seen / SATURATED) ** 4, LEAST_SHARE), spread >= SPREAD)


def _shortest_half(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return half the length (m,) of the shortest interval that holds more than half of each row (m, k)."""
    ordered, most = np.sort(values, axis=1), values.shape[1] // 2
    return np.asarray((ordered[:, most:] - ordered[:, :-most]).min(axis=1) / 2)
