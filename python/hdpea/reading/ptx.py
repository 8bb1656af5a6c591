# SPDX-License-Identifier: GPL-3.0-or-later
"""PTX of Leica: scans in rows and columns, each with its pose."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import PointCloud
from hdpea.reading.tables import count_of, parse_table

_NUMBER = rb"[ \t]*[-+.\deE]+"
_ROW = rb"(?:" + _NUMBER + rb"){%d}\s*\n"
PTX = re.compile(rb"\s*\d+\s*\n\s*\d+\s*\n(?:" + _ROW % 3 + rb"){4}(?:" + _ROW % 4 + rb"){4}")
"""Columns and rows, position and axes of the scanner, and the transformation of the points (4, 4)."""

HEADER = 10
"""Lines before the points of a scan."""

_NAMES = ("intensity", "red", "green", "blue")


def parse_ptx(data: bytes) -> PointCloud:
    """Read the scans of a PTX file where their poses put them, and from where each point was seen.

    A pixel without a point, which the format writes as the origin, is left out.

    Raises
    ------
    UnreadableInput
        If the file ends early, or a line is not as many numbers as the others of its scan.
    """
    lines = [line for line in data.decode("utf-8", errors="replace").splitlines() if line.strip()]
    scans = list(_scans(lines))
    points = np.vstack([scan[0] for scan in scans])
    width = min(scan[1].shape[1] for scan in scans)
    others = np.vstack([scan[1][:, :width] for scan in scans])
    attributes = dict(zip(_NAMES, others.T, strict=False))
    sensors = np.vstack([scan[2] for scan in scans])
    if sensors.any():
        attributes["sensor"] = sensors
    seen = np.concatenate([scan[3] for scan in scans])
    missing = len(seen) - len(points)
    notes = (f"Left out pixels without a point: {missing:,}.",) if missing else ()
    kind = f"PTX, {len(scans)} scan{'s' if len(scans) > 1 else ''}"
    return PointCloud(points, None, attributes, kind, notes, point_index=np.flatnonzero(seen))


_Scan = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]
"""Points (n, 3), what follows them (n, c), where each was seen from (n, 3), and which pixels (p,) have a point."""


def _scans(lines: Sequence[str]) -> Iterator[_Scan]:
    start = 0
    while start < len(lines):
        body = start + HEADER
        if len(lines) < body:
            raise UnreadableInput("it ends in the header of a scan.", "It may have been cut off while being copied.")
        count = count_of(lines[start]) * count_of(lines[start + 1])
        sensor = parse_table(lines[start + 2 : start + 3], start + 3, 3)[0]
        transform = parse_table(lines[start + 6 : body], start + 7, 4)
        if len(lines) < body + count:
            raise UnreadableInput(
                f"it ends after {len(lines) - body} of the {count} pixels of a scan.",
                "It may have been cut off while being copied.",
            )
        table = parse_table(lines[body : body + count], body + 1)
        if table.shape[1] < 3:
            raise UnreadableInput(f"it has {table.shape[1]} numbers per line, where x, y and z are needed.")
        has_point = np.asarray(table[:, :3].any(axis=1))
        seen = table[has_point]
        # The matrix is that of row vectors: its last row is the translation.
        points = seen[:, :3] @ transform[:3, :3] + transform[3, :3]
        yield points, seen[:, 3:], np.tile(sensor, (len(seen), 1)), has_point
        start = body + count
