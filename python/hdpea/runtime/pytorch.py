# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether PyTorch is there: which of its builds fits the machine is the user's choice, so pip does not bring it."""

from __future__ import annotations

from importlib.util import find_spec

from hdpea.errors import UsageError


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
