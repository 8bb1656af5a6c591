# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C that works at once, whatever the process is busy with."""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from hdpea.errors import Interrupted
from hdpea.runtime.outputs import remove_unfinished

GRACE = 1.0
"""Seconds that an interrupted run has to end in good order."""


@contextmanager
def prompt_interrupts() -> Iterator[None]:
    """End the process within ``GRACE`` seconds of Ctrl-C, for use in the main thread.

    Python turns Ctrl-C into an exception between two of its own instructions, which may be far
    apart when compiled code is at work. A watching thread is woken by the signal itself and ends
    the process (exit code 130, half-written files removed) if the exception did not do so in time.
    """
    receiver, sender = socket.socketpair()
    sender.setblocking(False)
    previous = signal.set_wakeup_fd(sender.fileno(), warn_on_full_buffer=False)
    threading.Thread(target=_watch, args=(receiver,), daemon=True).start()
    try:
        yield
    finally:
        signal.set_wakeup_fd(previous)
        sender.close()


def _watch(receiver: socket.socket) -> None:
    with receiver:
        try:
            while received := receiver.recv(1):
                if received == bytes([signal.SIGINT]):
                    receiver.settimeout(GRACE)
        except TimeoutError:
            remove_unfinished()
            # Progress bars hide the cursor of a terminal.
            sys.stderr.write(("\x1b[?25h" if sys.stderr.isatty() else "") + f"\nError: {Interrupted().message}\n")
            sys.stderr.flush()
            os._exit(Interrupted.exit_code)
