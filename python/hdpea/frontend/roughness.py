# SPDX-License-Identifier: GPL-3.0-or-later
"""How rough a cloud is, measured on the points alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
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

REGION, ROUGHEST = 100, 0.8
"""Samples that make a region, and the quantile over regions of noise that is reported where they differ: noise grows
with the distance from a sensor."""

DIFFER, MOST_DIFFER, LEAST_NOISY = 1.5, 4.0, 0.4
"""How many times rougher than the cleanest the roughest regions then are, at least and at most, and which share of the
regions is noise.

With even noise of 0.1 and 0.3 % of the diagonal 13 training meshes have 1.13 at most, eight clouds of views 1.4; where
it grows with the square of a range of 3 to 5 radii, three shapes have 1.7 to 3. Of clean clouds of 126 training meshes,
two have 8 and more: parts that the points hardly show. Residuals of one spacing and of two hardly differ, so it is the
noise that is compared: of eight validation meshes with even noise of 0.1 to 1 spacing that differs 1.4 times at most;
where it grows from 0.1 to 2, 1.77 and more on a ball, a torus and all but lattice_lamp, whose struts are thinner."""

MOSTLY_NOISY = 0.55
"""Share of the regions that are noise from which on the roughest may be rougher than that.

Of clean clouds of 84 training meshes, of 40,000 and of 6,000 points, those with regions four times rougher have 0.44 at
most; sheets and balls whose noise grows from none to 0.3 to 1.5 spacings have 0.61 and more."""

SATURATED, LEAST_SHARE = 0.94, 0.25
"""Residual of a quadric, in spacings, that no noise exceeds, and the least share of the noise that it can be.

Seen by few neighbours, a thick shell is a solid ball. Corrected, noise of up to 1.5 spacings is measured to 15 %.
"""

MOST_TOLD = 1.5
"""Most noise of the roughest regions, in spacings: of more, residuals tell too little."""


@dataclass(frozen=True)
class Roughness:
    """How far points are off a smooth surface, and whether that is noise.

    Attributes
    ----------
    deviation
        Standard deviation across the surface, in spacings of the points (a spacing is the square root of the area per
        point): the residual of quadratic surfaces, so that curvature does not count. Of noise that differs from region
        to region that of the roughest.
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
    rows = rows_along(count, SAMPLES)
    patches = Patches.around(points, rows, NEIGHBORS)
    residuals = patches.residuals(PLANE)
    spreads = _shortest_half(residuals) / deviation(residuals, PLANE)
    deviations = deviation(patches.residuals(QUADRIC), QUADRIC) * np.sqrt(NEIGHBORS / np.pi)
    seen, like_noise = _unsaturated(float(np.quantile(deviations, CLEANEST))), float(np.median(spreads)) >= SPREAD
    roughest, share = _of_noisy_regions(np.ascontiguousarray(points[rows]), deviations, spreads)
    roughest = min(_unsaturated(roughest), MOST_TOLD)
    if DIFFER * seen < roughest and (roughest < MOST_DIFFER * seen or share >= MOSTLY_NOISY):
        seen, like_noise = roughest, True
    return Roughness(seen, like_noise)


def _unsaturated(residual: float) -> float:
    """Return the noise that leaves so large a residual of a quadric, both in spacings."""
    return residual / max(1 - (residual / SATURATED) ** 4, LEAST_SHARE)


def _of_noisy_regions(
    points: NDArray[np.float64], deviations: NDArray[np.float64], spreads: NDArray[np.float64]
) -> tuple[float, float]:
    """Return the deviation (m,) in the roughest regions around points (m, 3) where it is noise, and the share of these.

    The deviation is 0 if hardly any is.
    """
    if len(points) < 2 * REGION:
        return 0.0, 0.0
    around = _core.nearest_neighbors(points, points, REGION)
    noise = np.median(spreads[around], axis=1) >= SPREAD
    share = float(noise.mean())
    if share < LEAST_NOISY:
        return 0.0, share
    return float(np.quantile(np.quantile(deviations[around], CLEANEST, axis=1)[noise], ROUGHEST)), share


def _shortest_half(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return half the length (m,) of the shortest interval that holds more than half of each row (m, k)."""
    ordered, most = np.sort(values, axis=1), values.shape[1] // 2
    return np.asarray((ordered[:, most:] - ordered[:, :-most]).min(axis=1) / 2)
