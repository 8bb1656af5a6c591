# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays worked out some rows at a time, by several threads."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.runtime.threads import thread_count

ROWS_AT_ONCE = 4_000
"""Rows of a block: so few that what is made of them on the way stays in the caches, in memory that is there already.

Of 250,000 points, half of the front end's time went into fresh pages for arrays that were used once."""


def in_blocks(work: Callable[[slice], NDArray[Any]], count: int) -> NDArray[Any]:
    """Return what `work` makes of each block of `count` rows, one below the other.

    NumPy works without Python's lock, so blocks are worked on at the same time. What is made of a row must not depend
    on the others of its block.

    Examples
    --------
    >>> import numpy as np
    >>> rows = np.arange(10_000.0).reshape(5_000, 2)
    >>> in_blocks(lambda block: rows[block].sum(axis=1), 5_000).shape
    (5000,)
    """
    blocks = [slice(first, first + ROWS_AT_ONCE) for first in range(0, max(count, 1), ROWS_AT_ONCE)]
    threads = min(thread_count(), len(blocks))
    if threads == 1:
        return np.concatenate([work(block) for block in blocks])
    with ThreadPoolExecutor(threads) as pool:
        return np.concatenate(list(pool.map(work, blocks)))
