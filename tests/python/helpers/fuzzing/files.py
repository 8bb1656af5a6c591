# SPDX-License-Identifier: GPL-3.0-or-later
"""Good files of every format, damaged in every way; a case is known by its seed."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
from helpers.files import WITH_NORMALS, WITHOUT_NORMALS
from helpers.scanner_files import FILES

from hdpea.errors import UnreadableInput
from hdpea.reading import parse_points
from hdpea.reading.cleaning import cleaned

Random = np.random.Generator

GOOD = sorted({**WITH_NORMALS, **WITHOUT_NORMALS, **{name: made() for name, made in FILES.items()}}.items())

NUMBERS = [b"-1", b"0", b"400000000", b"99999999999999999999", b"1e400", b"nan", b"x", b"9" * 5000]


def _cut(random: Random, data: bytes) -> bytes:
    return data[: random.integers(0, len(data) + 1)]


def _flip(random: Random, data: bytes) -> bytes:
    spoilt = bytearray(data)
    for at in random.integers(0, max(len(data), 1), random.integers(1, 9)):
        if spoilt:
            spoilt[at] = random.integers(0, 256)
    return bytes(spoilt)


def _flip_header(random: Random, data: bytes) -> bytes:
    return _flip(random, data[:200]) + data[200:]


def _insert(random: Random, data: bytes) -> bytes:
    at = random.integers(0, len(data) + 1)
    junk = [b"\0" * 9, b"\n" * 50, b"# x y z\n", b'"', b",,,", b"\xff\xfe", b"end_header\n", random.bytes(30)]
    return data[:at] + junk[random.integers(0, len(junk))] + data[at:]


def _replace_number(random: Random, data: bytes) -> bytes:
    """Put another number in the place of one of the first: counts, shapes, versions."""
    digits = [at for at, byte in enumerate(data[:400]) if 48 <= byte <= 57]
    if not digits:
        return data
    start = digits[random.integers(0, len(digits))]
    end = start
    while end < len(data) and 48 <= data[end] <= 57:
        end += 1
    return data[:start] + NUMBERS[random.integers(0, len(NUMBERS))] + data[end:]


def _repeat(random: Random, data: bytes) -> bytes:
    start, end = sorted(random.integers(0, len(data) + 1, 2))
    return data[:end] + data[start:end] * int(random.integers(1, 4)) + data[end:]


def _join(random: Random, data: bytes) -> bytes:
    _, other = GOOD[random.integers(0, len(GOOD))]
    return _cut(random, data) + other


DAMAGES: list[Callable[[Random, bytes], bytes]] = [_cut, _flip, _flip_header, _insert, _replace_number, _repeat, _join]


def damaged(seed: int) -> tuple[str, bytes]:
    """Return the extension and the content of a damaged file."""
    random = np.random.default_rng([seed, 2])
    name, data = GOOD[random.integers(0, len(GOOD))]
    for _ in range(random.integers(1, 4)):
        data = DAMAGES[random.integers(0, len(DAMAGES))](random, data)
    return "." + name.rpartition(".")[2], data


def run(seed: int) -> str:
    """Read the damaged file of a seed; return how it ended: ``cloud``, or ``UnreadableInput``.

    Raises
    ------
    AssertionError
        If the cloud is not clean. Any other exception is a fault as well, and so is a warning.
    """
    extension, data = damaged(seed)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            cloud = cleaned(parse_points(data, extension))
        except UnreadableInput:
            return "UnreadableInput"
        cloud.sensors()
    assert cloud.points.ndim == 2, "the points are no table"
    assert cloud.points.shape[1] == 3, "the points are not in space"
    assert np.isfinite(cloud.points).all(), "a coordinate is not finite"
    assert len(np.unique(cloud.points, axis=0)) == len(cloud.points), "a point occurs twice"
    if cloud.normals is not None:
        lengths = np.linalg.norm(cloud.normals, axis=1)
        assert ((abs(lengths - 1) < 1e-9) | (lengths == 0)).all(), "a normal is neither of length 1 nor 0"
    return "cloud"
