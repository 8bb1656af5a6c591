# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks in the files that hdpea writes, by which it knows what it may replace: a scan is not made twice."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from hdpea.errors import UsageError

LOOKED_THROUGH = 4096
"""Bytes at the beginning and at the end of a file, one of which holds the mark."""


HEADERS = {"curvature": b"x,y,z,nx,ny,nz,direction1_x,"}
"""How tables of a kind begin: CSV has no comments, but no scan has such columns."""


def mark_of(kind: str) -> str:
    """Return what a file of this kind, such as ``"mesh"``, says of itself, as a comment of its format."""
    return f"made by hdpea: {kind}"


def is_marked(path: Path, kind: str) -> bool:
    """Say whether hdpea wrote the file as one of this kind: by its mark, or by the header of a table."""
    with path.open("rb") as file:
        beginning = file.read(LOOKED_THROUGH)
        if kind in HEADERS and beginning.startswith(HEADERS[kind]):
            return True
        size = file.seek(0, 2)
        file.seek(max(size - LOOKED_THROUGH, 0))
        return mark_of(kind).encode() in beginning + b"\0" + file.read()


def check_replaceable(outputs: Mapping[Path, str], force: bool) -> None:
    """Make sure that no file is lost for which there may be no other.

    Parameters
    ----------
    outputs
        The files that are to be written, and the kind of each.
    force
        Whether files that hdpea did not write may be replaced.

    Raises
    ------
    UsageError
        If one of them exists, and hdpea did not write it as one of that kind.
    """
    for path, kind in outputs.items():
        try:
            kept = not force and path.is_file() and not is_marked(path, kind)
        except OSError as error:
            raise UsageError(f"Cannot replace {path}: {error.strerror}.", "Choose another name.") from error
        if kept:
            hint = "Choose another name, or say `force=True` to replace it."
            raise UsageError(f"{path} exists, and is no {kind} that hdpea made.", hint)
