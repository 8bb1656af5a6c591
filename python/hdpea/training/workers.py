# SPDX-License-Identifier: GPL-3.0-or-later
"""The processes that train together: one, or as many as ``torchrun`` started."""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field

import torch
from torch import distributed, nn

from hdpea.runtime.pytorch import torch_device
from hdpea.training.options import TrainingOptions


@dataclass(frozen=True)
class Workers:
    """One of `count` processes, each of which trains on its share of a batch; all hold the same weights."""

    rank: int = 0
    count: int = 1
    device: torch.device = field(default_factory=lambda: torch.device("cpu"))

    def average_gradients(self, network: nn.Module) -> None:
        """Replace the gradients of a network by their means over all processes.

        Not by ``DistributedDataParallel``, of which the group's threads outlive the group (PyTorch 2.13): one that
        frees a tensor while the interpreter ends aborts the process.
        """
        if self.count == 1:
            return
        gradients = [weights.grad for weights in network.parameters() if weights.grad is not None]
        means = nn.utils.parameters_to_vector(gradients)
        distributed.all_reduce(means)
        nn.utils.vector_to_parameters(means / self.count, gradients)

    def mean(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return the means of values over all processes."""
        if self.count == 1:
            return dict(values)
        sums = torch.tensor(list(values.values()), dtype=torch.float64, device=self.device)
        distributed.all_reduce(sums)
        return dict(zip(values, (sums / self.count).tolist(), strict=True))


@contextmanager
def joined_workers(device: str = TrainingOptions.device) -> Iterator[Workers]:
    """Join the processes started by ``torchrun``, if any; each takes a GPU of its own, unless `device` is another.

    Raises
    ------
    UsageError
        If there is no such device.
    """
    own, count = torch_device(device), int(os.environ.get("WORLD_SIZE", "1"))
    if count == 1:
        yield Workers(device=own)
        return
    if own.type == "cuda":
        own = torch_device(f"cuda:{os.environ.get('LOCAL_RANK', '0')}")
    # Imported while there is a group, its functions keep that group, and its threads, as a default argument.
    importlib.import_module("torch.distributed.nn")
    distributed.init_process_group("nccl" if own.type == "cuda" else "gloo")
    try:
        yield Workers(distributed.get_rank(), count, own)
    finally:
        distributed.destroy_process_group()
