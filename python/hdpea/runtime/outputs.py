# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are written whole or not at all, and refused before the work rather than after it."""

from __future__ import annotations

import os
import secrets
import shutil
import stat
import tempfile
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager, suppress
from difflib import get_close_matches
from pathlib import Path

from hdpea.errors import UsageError

STANDARD_INPUT = "-"

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
        If the extension is not one of them, the name is no file's name, the folder is missing or cannot be
        written, or a folder or device is in the way.
    """
    if not path.name:
        raise UsageError("An output has no name.", "Give one; in a script, see that the variable is set.")
    if path.suffix.lower() not in extensions:
        listed = ", ".join(extensions)
        near = get_close_matches(path.suffix.lower(), extensions, n=1) or list(extensions)
        hint = f"The extension is the format: {path.stem.rstrip('.')}{near[0]}, say."
        raise UsageError(f"Cannot write {path}: its extension is not one of {listed}.", hint)
    try:
        earlier = _status(path)
    except OSError as error:
        raise UsageError(f"Cannot write {path}: {error.strerror}.", "Choose another name.") from error
    # Only a link can lead to another folder.
    folder = _target(path).parent if path.is_symlink() else path.parent
    if not folder.is_dir():
        if folder.exists():
            raise UsageError(f"Cannot write {path}: {folder} is no folder.", "Choose another name.")
        raise UsageError(f"Cannot write {path}: there is no folder {folder}.", f"mkdir -p {folder}")
    if earlier is not None and not stat.S_ISREG(earlier.st_mode):
        raise UsageError(f"Cannot write {path}: it exists and is not a file.", "Choose another name.")
    try:
        # Permissions and read-only disks are many; only a file that was made proves that one can be.
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise UsageError(
            f"Cannot write {path}: {error.strerror} in {folder}.", "Choose a folder you may write in."
        ) from error


def check_distinct(inputs: Iterable[Path | str | None], outputs: Iterable[Path | None]) -> None:
    """Make sure that no output takes the place of an input or of another output.

    Parameters
    ----------
    inputs
        Every file that is read; ``-`` is standard input.
    outputs
        Every file that is written. None, in both, is one that was not given.

    Raises
    ------
    UsageError
        If two of them are the same file, be it through links.
    """
    read = [_identity(each) for each in inputs if each is not None]
    written: dict[object, Path] = {}
    for path in outputs:
        if path is None:
            continue
        identity = _identity(path)
        if identity in read:
            raise UsageError(f"{path} is both input and output.", "The input would be lost; choose another name.")
        if identity in written:
            raise UsageError(f"{written[identity]} and {path} are the same output.", "Choose another name for one.")
        written[identity] = path


def check_outside(folder: Path, inputs: Iterable[Path | str | None]) -> None:
    """Make sure that no input, a file or a folder, lies in the `folder` whose files are to be written.

    Raises
    ------
    UsageError
        If one does.
    """
    filled = _target(folder)
    for each in inputs:
        if each is not None and _target(Path(each)).is_relative_to(filled):
            raise UsageError(f"{each} lies in {folder}, which is the output.", "It could be lost; choose another.")


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path beside `path`, which takes its place at the end, or vanishes after an error.

    The temporary file has the extension of `path` in lower case, by which some libraries choose the format.

    Raises
    ------
    UsageError
        If the disk refuses, for example because it is full.
    """
    target = _target(path)
    # Not the name itself, which may be as long as a name can be.
    partial = target.with_name(f".{secrets.token_hex(4)}.{os.getpid()}{path.suffix.lower()}")
    _unfinished.add(partial)
    try:
        yield partial
        partial.replace(target)
    except OSError as error:
        raise UsageError(f"Cannot write {path}: {error.strerror or error}.", "Is the disk full?") from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)
        _unfinished.discard(partial)


@contextmanager
def unfinished_folder(beside: Path) -> Iterator[Path]:
    """Give a temporary folder in the folder `beside`, out of which finished files are moved; it vanishes in the end.

    Raises
    ------
    UsageError
        If it cannot be made.
    """
    folder = beside / f".{secrets.token_hex(4)}.{os.getpid()}"
    _unfinished.add(folder)
    try:
        folder.mkdir()
    except OSError as error:
        _unfinished.discard(folder)
        raise UsageError(f"Cannot write in {beside}: {error.strerror}.", "Choose a folder you may write in.") from error
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        _unfinished.discard(folder)


def remove_unfinished() -> None:
    """Remove what is half written, for a process that must end at once."""
    for partial in list(_unfinished):
        shutil.rmtree(partial, ignore_errors=True)
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def _target(path: Path) -> Path:
    """Return the file that `path` leads to, through links; ``resolve`` would raise an error for links in a circle."""
    return Path(os.path.realpath(path))


def _status(path: Path) -> os.stat_result | None:
    """Return what is known of the file, None if there is none; OSError if there never can be."""
    try:
        return path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return None
    except ValueError as error:  # a name with a zero byte
        raise OSError(None, str(error)) from error


def _identity(path: Path | str) -> object:
    """Return what two names have in common if and only if they are of one file."""
    with suppress(OSError, ValueError):
        found = os.fstat(0) if str(path) == STANDARD_INPUT else Path(path).stat()
        return found.st_dev, found.st_ino
    return _target(Path(path))
