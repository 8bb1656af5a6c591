# SPDX-License-Identifier: GPL-3.0-or-later
"""Ctrl-C, and requests to end, that work at once, whatever the process is busy with."""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType

from hdpea.errors import HdpeaError, Interrupted, Terminated
from hdpea.runtime.outputs import remove_unfinished

GRACE = 1.0
"""Seconds that an interrupted run has to end in good order."""

_MEANINGS: dict[int, type[Interrupted | Terminated]] = {
    signal.SIGINT: Interrupted,
    signal.SIGTERM: Terminated,
    signal.SIGHUP: Terminated,
}


@contextmanager
def prompt_interrupts() -> Iterator[None]:
    """End the process within ``GRACE`` seconds of Ctrl-C, SIGTERM or SIGHUP, for use in the main thread.

    Python turns Ctrl-C into an exception between two of its own instructions, which may be far
    apart when compiled code is at work; the other two signals are treated like it here. A watching
    thread is woken by the signal itself and ends the process (with the exit code of the error, and
    half-written files removed) if the exception did not do so in time.

    Raises
    ------
    Terminated
        In place of what SIGTERM or SIGHUP interrupted. Ctrl-C stays a ``KeyboardInterrupt``.
    """
    receiver, sender = socket.socketpair()
    sender.setblocking(False)
    terminated = False

    def terminate(_number: int, _frame: FrameType | None) -> None:
        nonlocal terminated
        terminated = True
        # Unlike an error of hdpea's own, it is not taken for the failure of one task among many.
        raise KeyboardInterrupt

    # A signal that is ignored, as by nohup, or handled by the program around, stays so.
    changed = [each for each in (signal.SIGTERM, signal.SIGHUP) if signal.getsignal(each) is signal.SIG_DFL]
    for each in changed:
        signal.signal(each, terminate)
    previous = signal.set_wakeup_fd(sender.fileno(), warn_on_full_buffer=False)
    threading.Thread(target=_watch, args=(receiver,), daemon=True).start()
    try:
        yield
    except BaseException as error:
        if terminated:
            raise Terminated from error
        raise
    finally:
        signal.set_wakeup_fd(previous)
        for each in changed:
            signal.signal(each, signal.SIG_DFL)
        sender.close()


def _watch(receiver: socket.socket) -> None:
    meant: HdpeaError = Interrupted()
    with receiver:
        try:
            while received := receiver.recv(1):
                if received[0] in _MEANINGS:
                    meant = _MEANINGS[received[0]]()
                    receiver.settimeout(GRACE)
        except TimeoutError:
            remove_unfinished()
            with suppress(OSError, ValueError, AttributeError):  # whatever standard error has become
                # Progress bars hide the cursor of a terminal.
                sys.stderr.write(("\x1b[?25h" if sys.stderr.isatty() else "") + f"\nError: {meant.message}\n")
                sys.stderr.flush()
            os._exit(meant.exit_code)
