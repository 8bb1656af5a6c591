# SPDX-License-Identifier: GPL-3.0-or-later
"""How many threads a run uses. The result never depends on it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

# Waiting threads of torch's OpenMP must sleep, not spin: on a busy machine spinning made the particles
# fifty times slower. Read by OpenMP once, when torch is imported.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

MOST_THREADS = 256
"""More than any machine gains from; memory is reserved for each."""


@contextmanager
def limited_threads(count: int) -> Iterator[None]:
    """Limit the core and torch to `count` threads meanwhile, ``MOST_THREADS`` at most; 0: no limit."""
    if count == 0:
        # Nothing to tell torch, which a run may not need, and takes seconds to load.
        yield
        return
    import torch

    from hdpea import _core

    before, count = torch.get_num_threads(), min(count, MOST_THREADS)
    torch.set_num_threads(count)
    _core.set_thread_limit(count)
    try:
        yield
    finally:
        _core.set_thread_limit(0)
        torch.set_num_threads(before)
