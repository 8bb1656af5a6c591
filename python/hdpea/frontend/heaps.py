# SPDX-License-Identifier: GPL-3.0-or-later
"""Strays that keep company as close as what was kept does: a part of the scan rather than strays, and missing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

COMPANY = 8
"""Nearest points that must all be strays, too."""

AS_CLOSE = 0.9
"""Quantile of how far they lie from what is kept, up to which they lie as close."""

MOST_IN_HEAPS = 0.1
"""Share of the points from which a mesh without them is not what was wanted.

Of cables, whose points pass for scan lines and the rest for strays, it is 15 to 27 %; of spheres with 10 to 300 % of
outliers, near them and anywhere in their box, 1.3 % at most."""


def in_heaps(points: NDArray[np.float64], nearest: NDArray[np.int64], strays: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which of the `strays` (n,) among points (n, 3) lie among strays alone, and as close as the rest, (n,).

    Of each point the `nearest` (n, 8) or more are known.
    """
    if not strays.any():
        return strays
    near = nearest[:, :COMPANY]
    reach = np.linalg.norm(points[near[:, -1]] - points, axis=1)
    close = reach <= np.quantile(reach[~strays], AS_CLOSE)
    return np.asarray(strays & close & strays[near].all(axis=1))


def missing_with_heaps(count: int, of: int) -> tuple[str, ...]:
    """Return a sentence if so many points in heaps, `of` all, are too many to be left out."""
    if count <= MOST_IN_HEAPS * of:
        return ()
    return (f"{count / of:.0%} of the points were left out as strays, but lie as close together as the rest.",)
