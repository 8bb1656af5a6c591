# SPDX-License-Identifier: GPL-3.0-or-later
"""The device on which PyTorch computes, by its name."""

from __future__ import annotations

import re
from typing import Any

from hdpea.errors import UsageError
from hdpea.options.checked import option

_NAME = re.compile(r"auto|cpu|cuda(:\d{1,3})?")


def device_option(what: str) -> Any:
    """Return the option of the device on which `what` is computed."""
    return option("auto", f"where {what}: cpu; cuda, or cuda:1 for the second GPU; auto: a GPU if PyTorch has one")


def check_device(name: str) -> None:
    """Refuse what is no name of a device, whether or not the machine has it.

    Raises
    ------
    UsageError
        If it is none.
    """
    if not _NAME.fullmatch(name):
        raise UsageError(f"`device` is auto, cpu, cuda, or cuda with a number such as cuda:1, not {name!r}.")
