# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong, by whose fault it is; each kind is one exit code of the command."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import ClassVar


class HdpeaError(Exception):
    """An error to be told to the user: one clear sentence, and a hint what to do about it.

    Options are named in backquotes, as in Python: `orient='auto'`; the command line turns that into its flags.

    Raised itself (exit code 1) where nothing but hdpea or the machine is to blame.
    """

    exit_code: ClassVar[int] = 1
    usual_hint: ClassVar[str] = ""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint or self.usual_hint


class UsageError(HdpeaError):
    """The caller asked for something illegal: an option, a combination, an output that cannot be written."""

    exit_code = 2


class UnreadableInput(HdpeaError):
    """The input is missing, damaged, of an unknown format or holds no points."""

    exit_code = 3
    usual_hint = "Check that it is the right file, and whole."


class CannotReconstruct(HdpeaError):
    """The points were read, but no surface can be made of them."""

    exit_code = 4
    usual_hint = "`hdpea info` shows what the points are like."


class QualityMissed(HdpeaError):
    """The mesh was made and written, but is not what was asked for, or not what the points show."""

    exit_code = 5


class Interrupted(HdpeaError):
    """The user, or a progress callback, asked to stop."""

    exit_code = 130

    def __init__(self) -> None:
        super().__init__("Interrupted; nothing half-written is left.")


class Terminated(HdpeaError):
    """The system, or another program, asked the process to end (SIGTERM, or SIGHUP when its terminal is closed)."""

    exit_code = 143

    def __init__(self) -> None:
        super().__init__("Terminated; nothing half-written is left.")


@contextmanager
def core_errors_translated() -> Iterator[None]:
    """Turn what the compiled core throws into the errors of this module.

    Wrap every public function that calls the core; nesting does no harm.
    """
    try:
        yield
    except (MemoryError, ValueError, RuntimeError) as error:
        # Imported this late because the command line must start without the core.
        from hdpea import _core

        # torch has no error of its own for it.
        if isinstance(error, MemoryError) or "can't allocate memory" in str(error):
            raise HdpeaError("There is not enough memory.", "`hdpea info` says what a run needs.") from error
        if isinstance(error, _core.InvalidArgument):
            hint = "A stage was given what it does not take: check the arrays and lengths that you gave."
            raise UsageError(_sentence(error), hint) from error
        if isinstance(error, _core.CannotReconstruct):
            hint = "The points may lie in a few places, or be spread too unevenly."
            raise CannotReconstruct(_sentence(error), hint) from error
        if isinstance(error, _core.Cancelled):
            raise Interrupted from error
        raise


def _sentence(error: Exception) -> str:
    """Return what the core says, which is a clause, as a sentence; names such as fill_holes stay as they are."""
    clause = str(error).removesuffix(".")
    return f"{clause[:1].upper() if clause.split(' ')[0].isalpha() else clause[:1]}{clause[1:]}."
