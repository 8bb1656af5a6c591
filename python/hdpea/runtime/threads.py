# SPDX-License-Identifier: GPL-3.0-or-later
"""How many threads a run uses. The result never depends on it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext

from hdpea.runtime.pytorch import has_pytorch

# Waiting threads of torch's OpenMP must sleep, not spin: on a busy machine spinning made the particles
# fifty times slower. Read by OpenMP once, when torch is imported.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

# torch's BLAS on Intel's and AMD's processors, MKL, otherwise sums in an order that depends on the number of threads;
# on AVX2 for nearly every matrix. In its strict mode it does not, at the same speed. Read at the first product.
os.environ.setdefault("MKL_CBWR", "AUTO,STRICT")


MOST_THREADS = max(64, os.cpu_count() or 1)
"""More are of no use, and each takes memory even while it waits."""

FEW_ROWS = 64
"""Matrix products of fewer rows are computed by one thread."""


_limit = 0
"""Of the threads of the core, as it was last set; 0: none."""


def thread_count() -> int:
    """Return how many threads are to be used now."""
    return _limit or os.cpu_count() or 1


@contextmanager
def limited_threads(count: int) -> Iterator[None]:
    """Limit the core and torch to `count` threads meanwhile, at most ``MOST_THREADS``; 0: no limit."""
    if count == 0:
        # Nothing to tell torch, which a run may not need, and takes seconds to load.
        yield
        return
    _limit_core(count := min(count, MOST_THREADS))
    try:
        with _limited_torch(count) if has_pytorch() else nullcontext():
            yield
    finally:
        _limit_core(0)


def _limit_core(count: int) -> None:
    from hdpea import _core

    global _limit  # noqa: PLW0603 - as there is one limit of the core
    _core.set_thread_limit(count)
    _limit = count


@contextmanager
def _limited_torch(count: int) -> Iterator[None]:
    import torch

    before = torch.get_num_threads()
    torch.set_num_threads(count)
    try:
        yield
    finally:
        torch.set_num_threads(before)


@contextmanager
def fixed_order(rows: int, columns: int) -> Iterator[None]:
    """Compute small matrix products by one thread, so that the number of threads changes no bit of the result.

    For few rows, and for a single column, a BLAS without a strict mode, such as OpenBLAS, splits the work such that
    sums run in another order for another number of threads. Larger products are split by rows, each of which is summed
    in one order. The small ones would gain nothing from more threads. MKL has one (see above).
    """
    import torch

    threads = torch.get_num_threads()
    if threads == 1 or (rows >= FEW_ROWS and columns > 1):
        yield
        return
    torch.set_num_threads(1)
    try:
        yield
    finally:
        torch.set_num_threads(threads)
