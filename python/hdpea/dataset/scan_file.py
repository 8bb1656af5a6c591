# SPDX-License-Identifier: GPL-3.0-or-later
"""A scan as a PLY file, for any program that reads point clouds."""

from __future__ import annotations

from pathlib import Path

from hdpea.dataset.scan import Scan
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.points import point_ply

SENSOR_NAMES = ("sensor_x", "sensor_y", "sensor_z")


def write_scan(path: Path, scan: Scan, frame: UnitFrame) -> None:
    """Write the points of a scan in world coordinates, with normals and the position of the sensor that saw each.

    Raises
    ------
    UsageError
        If the file cannot be written, or its name does not end in .ply.
    """
    check_output(path, (".ply",))
    others = dict(zip(SENSOR_NAMES, frame.to_world(scan.sensors).T, strict=True))
    with replacing(path) as partial:
        partial.write_bytes(point_ply(frame.to_world(scan.points), scan.normals, others))
