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
