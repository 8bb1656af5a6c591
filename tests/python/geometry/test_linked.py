# SPDX-License-Identifier: GPL-3.0-or-later
"""What hangs together, told by its first."""

from __future__ import annotations

import numpy as np

from hdpea.geometry.linked import first_linked


def test_chains_in_any_order_have_the_label_of_their_first() -> None:
    order = np.random.default_rng(0).permutation(1000)
    ones, others = order[:-1], order[1:]
    kept = np.arange(999) != 499  # two chains of 500
    labels = first_linked(1002, ones[kept], others[kept])
    for chain in (order[:500], order[500:], [1000], [1001]):
        assert (labels[chain] == np.min(chain)).all()
