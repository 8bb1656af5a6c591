# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are written whole or not at all, and refused before the work rather than after it."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

from hdpea.errors import UsageError

_unfinished: set[Path] = set()


def check_output(path: Path, extensions: Collection[str]) -> None:
    """Make sure that `path` can be written, as far as can be known beforehand.

    Parameters
    ----------
    path
        The file to be written.
    extensions
        The legal ones, in lower case, with their dot.

    Raises
    ------
    UsageError
        If the extension is not one of them, the folder is missing or cannot be written, or a
        folder or device is in the way.
    """
    if path.suffix.lower() not in extensions:
        listed = ", ".join(extensions)
        raise UsageError(f"Cannot write {path}: its extension is not one of {listed}.", "The extension is the format.")
    if not path.parent.is_dir():
        raise UsageError(f"Cannot write {path}: there is no folder {path.parent}.", f"mkdir -p {path.parent}")
    if path.exists() and not path.is_file():
        raise UsageError(f"Cannot write {path}: it exists and is not a file.", "Choose another name.")
    try:
        # Permissions and read-only disks are many; only a file that was made proves that one can be.
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise UsageError(
            f"Cannot write {path}: {error.strerror} in {path.parent}.", "Choose a folder you may write in."
        ) from error


def check_not_input(path: Path, source: str) -> None:
    """Make sure that the output does not take the place of the input.

    Raises
    ------
    UsageError
        If both are the same file.
    """
    if path.resolve() == Path(source).resolve():
        raise UsageError(f"{path} is both input and output.", "The scan would be lost; choose another name.")


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside `path`, which takes its place at the end, or vanishes after an error.

    Raises
    ------
    UsageError
        If the disk refuses, for example because it is full.
    """
    target = path.resolve()
    partial = target.with_name(f".{target.stem}.{os.getpid()}{target.suffix}")
    _unfinished.add(partial)
    try:
        yield partial
        partial.replace(target)
    except OSError as error:
        raise UsageError(f"Cannot write {path}: {error.strerror}.", "Is the disk full?") from error
    finally:
        partial.unlink(missing_ok=True)
        _unfinished.discard(partial)


def remove_unfinished() -> None:
    """Remove what is half written, for a process that must end at once."""
    for partial in list(_unfinished):
        partial.unlink(missing_ok=True)
