# SPDX-License-Identifier: GPL-3.0-or-later
"""Standard streams that may be closed or full, which must not cost anyone a mesh."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import TextIO

from hdpea.errors import UsageError


@contextmanager
def sound_streams() -> Iterator[None]:
    """Stand in for the standard streams of the process meanwhile.

    What cannot be written to standard error, such as progress, is dropped. The first thing that cannot be written to
    standard output, which is a result, is a ``UsageError``. The numbers 0 to 2 of streams that were closed are
    taken, or the next file to be opened would get one, and with it whatever a library has to say.
    """
    # For reading only, so that writing fails as it does to a closed stream.
    while (number := os.open(os.devnull, os.O_RDONLY)) <= 2:
        os.set_inheritable(number, True)
    os.close(number)
    before = sys.stdout, sys.stderr
    sys.stdout, sys.stderr = _standing_in(1, sys.stdout, _refuse), _standing_in(2, sys.stderr, lambda _: None)
    try:
        yield
    finally:
        with suppress(UsageError):
            sys.stdout.flush()
        sys.stdout, sys.stderr = before


def _refuse(error: OSError) -> None:
    raise UsageError(f"Cannot write to standard output: {error.strerror}.", "Send it elsewhere.") from error


def _standing_in(number: int, stream: TextIO | None, failed: Callable[[OSError], None]) -> TextIO:
    """Return a stream to the same place as `stream`, None if it was closed; names of files need not be text."""
    encoding = stream.encoding if stream else "utf-8"
    raw = _Raw(number, failed)
    buffered = io.BufferedWriter(raw)  # type: ignore[type-var]
    return io.TextIOWrapper(buffered, encoding, "backslashreplace", line_buffering=number == 2 or raw.isatty())


class _Raw(io.RawIOBase):
    """Writes to a file descriptor until that fails once, and then no more."""

    def __init__(self, number: int, failed: Callable[[OSError], None]) -> None:
        self._number, self._failed, self._broken = number, failed, False

    def writable(self) -> bool:
        return True

    def isatty(self) -> bool:
        return os.isatty(self._number)

    def fileno(self) -> int:
        return self._number

    def write(self, data: bytes | bytearray | memoryview) -> int:  # type: ignore[override]
        """Write what there is room for; pretend to if nothing can be written."""
        if not self._broken:
            try:
                return os.write(self._number, data)
            except OSError as error:
                self._broken = True
                self._failed(error)
        return len(data)
