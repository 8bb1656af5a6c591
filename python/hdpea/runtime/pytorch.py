# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether PyTorch is there, and on what it computes.

Which of its builds fits the machine is the user's choice, so pip does not bring it.
"""

from __future__ import annotations

import gc
import os
import sys
from contextlib import suppress
from importlib import import_module
from importlib.util import find_spec
from threading import Thread
from typing import TYPE_CHECKING

from hdpea.errors import UsageError

if TYPE_CHECKING:
    import torch


def has_pytorch() -> bool:
    """Return whether PyTorch is installed, without the seconds that it takes to load."""
    return find_spec("torch") is not None


def check_pytorch() -> None:
    """Make sure that PyTorch is installed.

    Raises
    ------
    UsageError
        If it is not, with how to get it.
    """
    if not has_pytorch():
        raise UsageError(
            "PyTorch is not installed.",
            "The small build, for any processor: pip install torch --index-url https://download.pytorch.org/whl/cpu. "
            "The usual one, on Linux with CUDA and several GB large: pip install 'hdpea[torch]'.",
        )


def load_in_background() -> None:
    """Begin to load PyTorch, if it is there, beside the stages that do without it; an import waits for the rest."""
    if "torch" not in sys.modules and has_pytorch():
        # Its threads wait for each other by spinning otherwise, which on busy cores takes many times as long.
        os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
        Thread(target=_load).start()


def _load() -> None:
    # Nothing that an import makes is garbage, and the collector would go through all of it over and over.
    collects = gc.isenabled()
    gc.disable()
    try:
        # It fails where the run has ended meanwhile; whoever needs it meets any other error on importing it again.
        with suppress(Exception):
            import_module("torch")
    finally:
        if collects:
            gc.enable()


def torch_device(name: str) -> torch.device:
    """Return the device of a name: ``auto``, ``cpu``, ``cuda`` or ``cuda:n``; auto is the first GPU, if there is any.

    Raises
    ------
    UsageError
        If PyTorch, as it is installed, finds no such GPU.
    """
    import torch

    gpus = torch.cuda.device_count() if torch.cuda.is_available() else 0
    if name == "cpu" or (name == "auto" and not gpus):
        return torch.device("cpu")
    number = int(name.partition(":")[2] or 0)
    if number >= gpus:
        found = "no GPU" if not gpus else f"only {gpus} GPU{'s' * (gpus > 1)}, numbered from 0"
        raise UsageError(
            f"There is no device {name}: PyTorch {torch.__version__} finds {found}.",
            "`device='cpu'` works everywhere; a GPU needs its driver and a build of PyTorch for CUDA.",
        )
    # Without it, products on a GPU may be summed in another order the next time.
    os.environ.setdefault("CUBLAS_WORKSPACE_CONFIG", ":4096:8")
    return torch.device("cuda", number)
