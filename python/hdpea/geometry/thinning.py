# SPDX-License-Identifier: GPL-3.0-or-later
"""Random subsets of clouds with more points than needed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def thinned(count: int, most: int) -> NDArray[np.int64]:
    """Return rows, ascending: all of `count`, or `most` of them at random, always the same."""
    if count <= most:
        return np.arange(count)
    return np.sort(np.random.default_rng(0).permutation(count)[:most])
