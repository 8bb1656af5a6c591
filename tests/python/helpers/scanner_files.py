# SPDX-License-Identifier: GPL-3.0-or-later
"""One small cloud with attributes, far from the origin, as the content of files of scanners."""

from __future__ import annotations

import gzip
import io
import tempfile
from collections.abc import Callable
from pathlib import Path

import laspy
import numpy as np
import pye57
import pypcd4
from helpers.clouds import sphere_points
from helpers.files import lines
from laspy.vlrs.known import WktCoordinateSystemVlr

COUNT = 60
STEP = 2.0**-10
FAR = np.array([1e7, 5e6, 1e3])
POINTS = FAR + np.round(3 * sphere_points(COUNT) / STEP) * STEP
"""(60, 3): multiples of a thousandth that is a power of two, so that LAS holds them exactly."""

INTENSITY = np.arange(COUNT, dtype=np.uint16)
CLASSES = np.arange(COUNT, dtype=np.uint8) % 5
RETURNS = 1 + np.arange(COUNT, dtype=np.uint8) % 3
COLORS = (np.arange(3 * COUNT, dtype=np.uint16).reshape(COUNT, 3) * 4) % 256
TIMES = 1e5 + np.arange(COUNT) / 8
SENSOR = FAR + np.array([10.0, 0.0, 2.0])
CRS = 'PROJCS["somewhere"]'
COLOR_NAMES = ("red", "green", "blue")


def las(compressed: bool, withheld: int = 0, filled: bool = True) -> bytes:
    """The points with all that the format has for them, or only where they are."""
    header = laspy.LasHeader(point_format=7, version="1.4")
    header.scales, header.offsets = np.full(3, STEP), FAR
    header.vlrs.append(WktCoordinateSystemVlr(CRS))
    header.add_extra_dim(laspy.ExtraBytesParams("roughness", "f4"))
    made = laspy.LasData(header)
    made.x, made.y, made.z = POINTS.T
    if filled:
        made.intensity, made.classification, made.return_number, made.gps_time = INTENSITY, CLASSES, RETURNS, TIMES
        made.red, made.green, made.blue = COLORS.T
        made["roughness"] = INTENSITY / np.float32(4)
    made.withheld = np.arange(COUNT) < withheld
    stream = io.BytesIO()
    made.write(stream, do_compress=compressed)
    return stream.getvalue()


def e57(scans: int = 1) -> bytes:
    """The points in as many scans, turned by a quarter about z and seen from ``SENSOR``."""
    turned = np.stack([(POINTS - SENSOR)[:, 1], -(POINTS - SENSOR)[:, 0], (POINTS - SENSOR)[:, 2]], axis=1)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "scans.e57")
        with pye57.E57(path, mode="w") as file:
            for rows in np.array_split(np.arange(COUNT), scans):
                columns = {f"cartesian{axis}": column for axis, column in zip("XYZ", turned[rows].T, strict=True)}
                columns["intensity"] = INTENSITY[rows].astype(np.float32)
                names = ("colorRed", "colorGreen", "colorBlue")
                columns |= dict(zip(names, COLORS[rows].astype(np.uint8).T, strict=True))
                file.write_scan_raw(columns, rotation=[0.5**0.5, 0, 0, 0.5**0.5], translation=SENSOR)
        return Path(path).read_bytes()


def pcd(encoding: pypcd4.Encoding) -> bytes:
    # As text, the floats that colours of 8 bits look like would lose their digits.
    kind = np.uint32 if encoding is pypcd4.Encoding.ASCII else np.float32
    colors = pypcd4.PointCloud.encode_rgb(COLORS.astype(np.uint8)).ravel().view(kind)
    names, kinds = ("x", "y", "z", "intensity", "rgb"), (*[np.float64] * 3, np.uint16, kind)
    made = pypcd4.PointCloud.from_points([*POINTS.T, INTENSITY, colors], names, kinds)
    metadata = made.metadata.derive(viewpoint=(*SENSOR, 1.0, 0.0, 0.0, 0.0))
    stream = io.BytesIO()
    pypcd4.PointCloud(metadata, made.pc_data).save(stream, encoding)
    return stream.getvalue()


def ptx() -> bytes:
    """Two scans, seen from ``SENSOR`` and turned as those of ``e57``; a tenth of the pixels has no point."""
    turned = np.stack([(POINTS - SENSOR)[:, 1], -(POINTS - SENSOR)[:, 0], (POINTS - SENSOR)[:, 2]], axis=1)
    x, y, z = SENSOR
    pose = f"{x} {y} {z}\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n{x} {y} {z} 1\n"
    rows = np.hstack([turned, INTENSITY[:, None], COLORS])
    half = COUNT // 2
    scans = (f"{half + 3}\n1\n{pose}{lines(part)}" for part in (rows[:half], rows[half:]))
    return "".join(scan + 3 * "0 0 0 0.5 0 0 0\n" for scan in scans).encode()


def pts() -> bytes:
    rows = np.hstack([POINTS, INTENSITY[:, None], COLORS])
    half = COUNT // 2
    return "".join(f"{half}\n{lines(part)}" for part in (rows[:half], rows[half:])).encode()


def csv() -> bytes:
    header = "Easting,Northing,Elevation,intensity,red,green,blue\n"
    return (header + lines(np.hstack([POINTS, INTENSITY[:, None], COLORS]), ",")).encode()


FILES: dict[str, Callable[[], bytes]] = {
    "scan.las": lambda: las(compressed=False),
    "scan.laz": lambda: las(compressed=True),
    "scan.e57": e57,
    "scans.e57": lambda: e57(3),
    "text.pcd": lambda: pcd(pypcd4.Encoding.ASCII),
    "binary.pcd": lambda: pcd(pypcd4.Encoding.BINARY),
    "compressed.pcd": lambda: pcd(pypcd4.Encoding.BINARY_COMPRESSED),
    "scans.ptx": ptx,
    "scans.pts": pts,
    "table.csv": csv,
    "table.csv.gz": lambda: gzip.compress(csv()),
}
WITH_SENSOR = ("scan.e57", "scans.e57", "text.pcd", "binary.pcd", "compressed.pcd", "scans.ptx")
