# SPDX-License-Identifier: GPL-3.0-or-later
"""Blocks of rows: as if all were worked out at once, whatever the number of threads."""

from __future__ import annotations

import numpy as np
import pytest

from hdpea.runtime.blocks import ROWS_AT_ONCE, in_blocks
from hdpea.runtime.threads import limited_threads, thread_count


@pytest.mark.parametrize("count", [0, 1, ROWS_AT_ONCE, 3 * ROWS_AT_ONCE + 7])
@pytest.mark.parametrize("threads", [1, 3])
def test_blocks_make_what_all_rows_make(count: int, threads: int) -> None:
    values = np.random.default_rng(0).random((count, 5))
    with limited_threads(threads):
        assert thread_count() == threads
        found = in_blocks(lambda rows: np.quantile(values[rows], 0.25, axis=1), count)
    np.testing.assert_array_equal(found, np.quantile(values, 0.25, axis=1))


def test_an_error_in_a_block_is_that_of_the_whole() -> None:
    with pytest.raises(ZeroDivisionError):
        in_blocks(lambda rows: np.array([1 // (rows.start - ROWS_AT_ONCE)]), 2 * ROWS_AT_ONCE)
