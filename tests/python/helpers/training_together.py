# SPDX-License-Identifier: GPL-3.0-or-later
"""One of the processes that torchrun starts in test_training.py."""

from __future__ import annotations

import sys
from pathlib import Path

from helpers.networks import QUICK, TINY, InMemory

from hdpea.training.loop import train
from hdpea.training.workers import joined_workers

if __name__ == "__main__":
    with joined_workers() as workers:
        train(InMemory(), None, Path(sys.argv[1]), TINY, QUICK, workers=workers)
    # A thread of the group's that frees a tensor while the interpreter ends aborts the process, once in a while.
    left = [name.read_text().strip() for name in Path("/proc/self/task").glob("*/comm") if "gloo" in name.read_text()]
    sys.exit(f"The group's threads are still there: {left}" if left else 0)
