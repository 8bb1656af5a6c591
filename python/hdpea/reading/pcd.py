# SPDX-License-Identifier: GPL-3.0-or-later
"""PCD of the Point Cloud Library, by pypcd4."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import PointCloud, from_columns

_PADDING = "#$%&~~"
"""What pypcd4 begins the names of padding with."""


def parse_pcd(data: bytes) -> PointCloud:
    """Read the points of a PCD file with all their fields; a viewpoint other than the origin is the sensor.

    Raises
    ------
    UnreadableInput
        If it has no x, y and z, or ends early.
    """
    from pypcd4.pypcd4 import PointCloud as Pcd

    cloud = Pcd.from_fileobj(io.BytesIO(data))  # type: ignore[arg-type] # any stream will do
    if len(cloud.pc_data) < cloud.metadata.points:
        raise UnreadableInput(
            f"it ends after {len(cloud.pc_data)} of its {cloud.metadata.points} points.",
            "It may have been cut off while being copied.",
        )
    columns: dict[str, NDArray[Any]] = {
        name: np.ascontiguousarray(cloud.pc_data[name]) for name in cloud.fields if not name.startswith(_PADDING)
    }
    for packed in {"rgb", "rgba"} & set(columns):
        colors = Pcd.decode_rgb(columns.pop(packed))
        columns |= dict(zip(("red", "green", "blue"), colors.T, strict=True))
    position = np.array(cloud.metadata.viewpoint[:3], np.float64)
    if position.any():
        columns["sensor"] = np.tile(position, (len(cloud.pc_data), 1))
    return from_columns(columns, f"{cloud.metadata.data.value} PCD")
