# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates that lost their digits: stored in 32 bits far from the origin, they lie on a grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.thinning import rows_along

SAMPLES = 2_000
"""Points at which the spacing is measured."""

COARSE = 0.25
"""Steps, in spacings of the points, from which they are told: they move points by 0.07 spacings, and from two times as
much on the cloud counts as noisy (``hdpea.options.denoising.ROUGH``)."""


def precision_note(points: NDArray[np.float64]) -> str | None:
    """Return a sentence if points (n, 3), finite and distinct, have the steps of 32-bit numbers, and these are coarse.

    Only such numbers are told: other grids, as of elevation models, may be as they were measured.
    """
    # What is too large for 32 bits did not come in them.
    with np.errstate(over="ignore"):
        single = points.astype(np.float32)
    if len(points) < 2 or not np.array_equal(single.astype(np.float64), points):
        return None
    step = float(np.spacing(abs(single).max()))
    rows = rows_along(len(points), SAMPLES)
    queries = np.ascontiguousarray(points[rows])
    # The nearest to a point of the cloud is the point itself.
    nearest = _core.nearest_neighbors(points, queries, 2)[:, 1]
    spacing = float(np.median(np.linalg.norm(points[nearest] - queries, axis=1)))
    if step < COARSE * spacing:
        return None
    return (
        f"The coordinates are 32-bit numbers in steps of {step:.2g}, and the points {spacing:.2g} apart: "
        "subtract an offset before they are stored."
    )
