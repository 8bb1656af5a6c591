# SPDX-License-Identifier: GPL-3.0-or-later
"""Point clouds from files and from standard input."""

from __future__ import annotations

import re
import struct
import sys
import zlib
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from pathlib import Path, PurePath
from tokenize import TokenError
from zipfile import BadZipFile

from plyfile import PlyParseError

from hdpea.errors import UnreadableInput
from hdpea.reading.arrays import parse_npy, parse_npz
from hdpea.reading.cloud import PointCloud, cleaned, require_points
from hdpea.reading.merging import merged
from hdpea.reading.meshes import parse_obj, parse_off
from hdpea.reading.ply import parse_ply
from hdpea.reading.text import parse_text

__all__ = ["CLOUD_FORMATS", "DAMAGE", "PointCloud", "parse_points", "read", "read_bytes", "read_points", "read_scans"]

CLOUD_FORMATS = (
    ".ply", ".xyz", ".xyzn", ".txt", ".csv", ".asc", ".pts", ".pwn", ".obj", ".off", ".npy", ".npz"
)  # fmt: skip
"""Extensions by which clouds are found in a folder; what a file holds is told by its content."""

_FORMATS: list[tuple[re.Pattern[bytes], Callable[[bytes], PointCloud]]] = [
    (re.compile(rb"ply\s"), parse_ply),
    (re.compile(rb"\x93NUMPY"), parse_npy),
    (re.compile(rb"PK\x03\x04"), parse_npz),
    # Possessive, since a file of nothing but blank lines has as many ways to match as it has lines.
    (re.compile(rb"(?:\s+|#[^\n]*\n)*+(ST)?C?N?OFF\b"), parse_off),
    (re.compile(rb"(?:\s+|#[^\n]*\n|(?:o|g|s|mtllib|usemtl)\s[^\n]*\n)*+v[nt]?\s"), parse_obj),
]
# What the libraries that read those formats raise over nonsense.
DAMAGE = (
    PlyParseError,
    ValueError,
    LookupError,
    TypeError,
    ArithmeticError,
    OSError,
    EOFError,
    SyntaxError,
    TokenError,
    BadZipFile,
    RuntimeError,
    struct.error,
    zlib.error,
)
_FOREIGN = {
    b"LASF": "LAS/LAZ",
    b"ASTM-E57": "E57",
    b"# .PCD": "PCD",
    b"glTF": "glTF",
    b"\x1f\x8b": "gzip",
    b"solid": "STL",
}
_READABLE = "hdpea reads PLY, XYZ/TXT/CSV/PTS/PWN text, OBJ, OFF, NPY and NPZ; convert the file to one of these."


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
        cloud = parse_points(data, Path(path).suffix.lower())
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
        near = _nearest_name(path)
        hint = f"Did you mean {near}?" if near else "Check the spelling and the folder."
        raise UnreadableInput(f"There is no file {path}.", hint) from error
    except IsADirectoryError as error:
        raise UnreadableInput(f"{path} is a folder, not a file.", "Give one file.") from error
    except OSError as error:
        raise UnreadableInput(f"Cannot read {path}: {error.strerror}.", "Check its permissions.") from error


def _nearest_name(path: Path) -> Path | None:
    try:
        names = [each.name for each in path.parent.iterdir()]
    except OSError:
        return None
    return next((path.parent / near for near in get_close_matches(path.name, names, 1, cutoff=0.75)), None)


def parse_points(data: bytes, extension: str = "") -> PointCloud:
    """Read the content of a file, as ``read_points`` does, without dropping anything.

    Raises
    ------
    UnreadableInput
        If the content is damaged, of an unknown format, or empty.
    """
    if not data or data.isspace():
        raise UnreadableInput("it is empty.", _READABLE)
    for magic, parse in _FORMATS:
        if magic.match(data):
            try:
                return parse(data)
            except DAMAGE as error:
                hint = "It may have been cut off while being copied."
                raise UnreadableInput(f"it is damaged ({error}).", hint) from error
    for prefix, foreign in _FOREIGN.items():
        if data.startswith(prefix):
            raise UnreadableInput(f"it is a {foreign} file.", _READABLE)
    if b"\0" in data[:4096]:
        raise UnreadableInput("its format is unknown.", _READABLE)
    return parse_text(data, normals_expected=extension in {".pwn", ".xyzn"})
