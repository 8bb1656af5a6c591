# SPDX-License-Identifier: GPL-3.0-or-later
"""The device that was chosen for PyTorch, as the report tells it."""

from __future__ import annotations

from hdpea.options.choice import Choice
from hdpea.runtime.pytorch import torch_device


def device_choices(name: str) -> tuple[Choice, ...]:
    """Return which device the option `name` comes to, unless it names one itself.

    Raises
    ------
    UsageError
        If the machine has no such device.
    """
    device = torch_device(name)
    if name != "auto":
        return ()
    why = "PyTorch finds no GPU" if device.type == "cpu" else "the first GPU that PyTorch finds"
    return (Choice("device", str(device), "", why),)
