# SPDX-License-Identifier: GPL-3.0-or-later
"""What hangs together: the connected components of things that are linked in pairs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def first_linked(count: int, ones: NDArray[np.integer], others: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return for each of `count` things (count,) the first of those that hang together with it, itself if none does.

    Parameters
    ----------
    ones, others
        (p,) each: the things of each pair that are linked, in either direction.
    """
    labels = np.arange(count)
    while True:
        least = np.minimum(labels[ones], labels[others])
        lowered = labels.copy()
        # With the label of an end that of the thing it names is lowered, so that few rounds are enough.
        for ends in (ones, others):
            np.minimum.at(lowered, labels[ends], least)
            np.minimum.at(lowered, ends, least)
        lowered = lowered[lowered]
        if np.array_equal(lowered, labels):
            return labels
        labels = lowered
