# SPDX-License-Identifier: GPL-3.0-or-later
"""E57, by pye57: scans, each with its pose."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import PointCloud, from_columns
from hdpea.reading.merging import merged

_TYPES = {
    "cartesianX": "f8", "cartesianY": "f8", "cartesianZ": "f8",
    "sphericalRange": "f8", "sphericalAzimuth": "f8", "sphericalElevation": "f8",
    "cartesianInvalidState": "u1", "sphericalInvalidState": "u1",
    "intensity": "f4", "colorRed": "u2", "colorGreen": "u2", "colorBlue": "u2",
    "timeStamp": "f8", "returnIndex": "u1", "nor:normalX": "f4", "nor:normalY": "f4", "nor:normalZ": "f4",
}  # fmt: skip
"""The fields that are read, and as what."""

_NAMES = {
    "intensity": "intensity", "colorRed": "red", "colorGreen": "green", "colorBlue": "blue", "timeStamp": "gps_time",
    "nor:normalX": "nx", "nor:normalY": "ny", "nor:normalZ": "nz",
}  # fmt: skip


def parse_e57(data: bytes) -> PointCloud:
    """Read the scans of an E57 file where their poses put them, and from where each point was seen.

    Points that are marked as invalid are left out.

    Raises
    ------
    RuntimeError
        If it is damaged.
    """
    import pye57

    # The library reads files only.
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scans.e57"
        path.write_bytes(data)
        with pye57.E57(str(path)) as file:
            headers = [file.get_header(i) for i in range(file.scan_count)]
            # Poses at the origin may as well mean that there are none; but of several scans one often is there.
            seen = any(header.translation.any() for header in headers)
            for header in headers:
                # Packed as tightly as can be, a point takes a bit.
                if header.point_count > 8 * len(data):
                    raise UnreadableInput(
                        f"it cannot hold the {header.point_count:,} points that its header announces.",
                        "It may have been cut off while being copied.",
                    )
            filled = [header for header in headers if header.point_count]
            starts = np.cumsum([0, *(header.point_count for header in filled)])
            scans = [_scan(file, header, seen) for header in filled]
            crs = _crs(file)
    if not scans:
        return PointCloud(np.empty((0, 3)), format="E57")
    kind = f"E57, {len(scans)} scan{'s' if len(scans) > 1 else ''}"
    point_index = np.concatenate([start + kept for start, (_, kept) in zip(starts, scans, strict=False)])
    return replace(merged([scan for scan, _ in scans]), format=kind, crs=crs, point_index=point_index)


def _scan(file: Any, header: Any, seen: bool) -> tuple[PointCloud, NDArray[np.int64]]:
    """Return the valid points of a scan, and which of all they are."""
    from pye57 import libe57
    from pye57.utils import convert_spherical_to_cartesian

    fields = {name: np.empty(header.point_count, kind) for name, kind in _TYPES.items() if name in header.point_fields}
    buffers = libe57.VectorSourceDestBuffer()
    for name, values in fields.items():
        buffers.append(libe57.SourceDestBuffer(file.image_file, name, values, len(values), True, True))
    header.points.reader(buffers).read()
    invalid = next(
        (fields[name] for name in ("cartesianInvalidState", "sphericalInvalidState") if name in fields), None
    )
    kept = np.arange(header.point_count) if invalid is None else np.flatnonzero(invalid == 0)
    if "cartesianX" in fields:
        local = np.stack([fields[f"cartesian{axis}"][kept] for axis in "XYZ"], axis=1)
    else:
        names = ("sphericalRange", "sphericalAzimuth", "sphericalElevation")
        local = convert_spherical_to_cartesian(np.stack([fields[name][kept] for name in names], axis=1))
    rotation = header.rotation_matrix
    points = local @ rotation.T + header.translation
    columns: dict[str, NDArray[Any]] = dict(zip("xyz", points.T, strict=True))
    columns |= {name: _narrow(fields[field][kept]) for field, name in _NAMES.items() if field in fields}
    if all(name in columns for name in ("nx", "ny", "nz")):
        normals = np.stack([columns[name] for name in ("nx", "ny", "nz")], axis=1) @ rotation.T
        columns |= dict(zip(("nx", "ny", "nz"), normals.T, strict=True))
    if "returnIndex" in fields:
        # The format counts from 0, where all others count from 1.
        columns["return_number"] = fields["returnIndex"][kept] + np.uint8(1)
    if seen:
        columns["sensor"] = np.tile(header.translation, (len(points), 1))
    return from_columns(columns, "E57"), kept


def _narrow(values: NDArray[Any]) -> NDArray[Any]:
    """Return colours of 8 bits as such; everything else as it is."""
    return values.astype(np.uint8) if values.dtype == np.uint16 and values.max(initial=0) <= 255 else values


def _crs(file: Any) -> str | None:
    root = file.root
    text = str(root["coordinateMetadata"].value()) if root.isDefined("coordinateMetadata") else ""
    return text or None
