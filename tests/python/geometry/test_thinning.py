# SPDX-License-Identifier: GPL-3.0-or-later
"""Subsets of rows."""

from __future__ import annotations

import numpy as np

from hdpea.geometry.thinning import rows_without


def test_rows_without_some_are_the_others() -> None:
    left_out = (np.array([4, 1]), np.array([1, 6]))
    assert rows_without(7, *left_out).tolist() == [0, 2, 3, 5]
    assert rows_without(3).tolist() == [0, 1, 2]
