# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C in a training: the current step is finished and saved first, so that nothing is lost."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from hdpea.errors import Interrupted


@contextmanager
def stop_requests() -> Iterator[Callable[[], bool]]:
    """Yield a function that tells whether Ctrl-C or SIGTERM has arrived; a second one ends the process at once."""
    asked = False

    def ask(_number: int, _frame: FrameType | None) -> None:
        nonlocal asked
        if asked:
            os._exit(Interrupted.exit_code)
        asked = True

    # The command line's watchdog ends a run after a second, which is too short to save a training.
    watchdog = signal.set_wakeup_fd(-1)
    before = {number: signal.signal(number, ask) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: asked
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        signal.set_wakeup_fd(watchdog)
