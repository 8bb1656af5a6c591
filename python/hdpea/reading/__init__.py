# SPDX-License-Identifier: GPL-3.0-or-later
"""Point clouds from files and from standard input."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path, PurePath

from hdpea.errors import UnreadableInput
from hdpea.reading.cleaning import cleaned, require_points
from hdpea.reading.cloud import PointCloud
from hdpea.reading.formats import CLOUD_FORMATS, DAMAGE, parse_points
from hdpea.reading.merging import merged
from hdpea.runtime.names import nearest_name

__all__ = ["CLOUD_FORMATS", "DAMAGE", "PointCloud", "parse_points", "read", "read_bytes", "read_points", "read_scans"]


def read_points(path: str | PurePath) -> PointCloud:
    """Read a point cloud; ``-`` is standard input.

    The format is told by the content, so a wrong extension does no harm; ``.pwn`` and ``.xyzn``
    only say that columns 4 to 6 of a text are normals.

    Returns
    -------
    PointCloud
        Cleaned: finite and distinct points, unit normals.

    Raises
    ------
    UnreadableInput
        If the file is missing, cannot be opened, is damaged, of an unknown format, or has no points.
    """
    return read_scans([path])


def read_scans(paths: Sequence[str | PurePath]) -> PointCloud:
    """Read scans of one thing, in one frame and unit, as one cloud.

    Raises
    ------
    UnreadableInput
        If one of them is what ``read_points`` cannot read, or they cannot be one cloud.
    """
    clouds = [_read(path) for path in paths]
    return cleaned(clouds[0] if len(clouds) == 1 else merged(clouds))


def _read(path: str | PurePath) -> PointCloud:
    name = "standard input" if str(path) == "-" else str(path)
    data = _standard_input() if str(path) == "-" else read_bytes(Path(path))
    try:
        cloud = parse_points(data, Path(str(path).lower().removesuffix(".gz")).suffix)
        require_points(cloud)
    except UnreadableInput as error:
        raise UnreadableInput(f"Cannot read {name}: {error.message}", error.hint) from error
    return cloud


read = read_points
"""The same, as ``hdpea.read``."""


def _standard_input() -> bytes:
    if sys.stdin is None:
        raise UnreadableInput("Cannot read standard input: it is closed.", "Pipe a file into it, or name the file.")
    try:
        return sys.stdin.buffer.read()
    except OSError as error:
        raise UnreadableInput(f"Cannot read standard input: {error.strerror or error}.", "Name the file.") from error


def read_bytes(path: Path) -> bytes:
    """Return the content of a file.

    Raises
    ------
    UnreadableInput
        If it is missing or cannot be opened.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError as error:
        near = nearest_name(path)
        hint = f"Did you mean {near}?" if near else "Check the spelling and the folder."
        if "*" in path.name:
            hint = "No file there has such a name."
        raise UnreadableInput(f"There is no file {path}.", hint) from error
    except IsADirectoryError as error:
        raise UnreadableInput(f"{path} is a folder, not a file.", "Give one file.") from error
    except OSError as error:
        raise UnreadableInput(f"Cannot read {path}: {error.strerror}.", "Check its permissions.") from error
