# SPDX-License-Identifier: GPL-3.0-or-later
"""The crops of a training, step after step, cut ahead of time: by a thread, or by processes of their own."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from torch.utils.data import DataLoader, Dataset

from hdpea import _core
from hdpea.training.crops import Crop, Samples, crop_number
from hdpea.training.options import TrainingOptions

AHEAD = 2
"""Steps for which each process cuts crops in advance."""


@dataclass(frozen=True)
class StepCrops(Dataset[Crop]):
    """The crops of each step, as a sequence: those that one of `count` processes trains on.

    Attributes
    ----------
    neighbors
        Nearest points that each point of a crop gets.
    rank, count
        As of ``Workers``.
    """

    samples: Samples
    options: TrainingOptions
    neighbors: int
    rank: int = 0
    count: int = 1

    def __getitem__(self, step: int) -> Crop:
        """Cut the crops of a step, and join them."""
        options = self.options
        numbers = range(step * options.batch + self.rank, (step + 1) * options.batch, self.count)
        cut = [crop_number(number, self.samples, options.crops, self.neighbors, options.seed) for number in numbers]
        return Crop.together(cut)


def prefetched(crops: StepCrops, first: int, end: int) -> Iterator[Crop]:
    """Yield the crops of the steps from `first` to before `end`, in order, each cut while others are trained on.

    Those of a step are the same for any number of ``options.loaders``, the processes that cut them; 0 stands for a
    thread of this one.
    """
    if not crops.options.loaders:
        yield from _by_thread(crops, first, end)
        return
    yield from DataLoader(
        crops,
        batch_size=None,
        sampler=range(first, end),
        num_workers=crops.options.loaders,
        prefetch_factor=AHEAD,
        worker_init_fn=_begin,
        # A process that already has threads must not be forked.
        multiprocessing_context="spawn",
    )


def _begin(_number: int) -> None:
    # The process that trains saves and ends them.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    _core.set_thread_limit(1)


def _by_thread(crops: StepCrops, first: int, end: int) -> Iterator[Crop]:
    with ThreadPoolExecutor(1) as pool:
        following = pool.submit(crops.__getitem__, first)
        for step in range(first, end):
            crop = following.result()
            if step + 1 < end:
                following = pool.submit(crops.__getitem__, step + 1)
            yield crop
