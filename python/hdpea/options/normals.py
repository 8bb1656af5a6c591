# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the normals and of which side is out."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options.checked import Checked, option
from hdpea.options.position import Position


@dataclass(frozen=True)
class NormalOptions(Checked):
    """Where normals come from, and which side is out (``hdpea.surface``)."""

    normals: str = option(
        "auto",
        "auto: the file's where they are usable, else estimated; all estimated if the file's do not lie across the "
        "surface; file: the file's or fail; estimate: always estimate",
        choices=("auto", "file", "estimate"),
    )
    normal_neighbors: int | None = option(
        None,
        "nearest points whose plane gives an estimated normal; default: two for each point per particle, 16 to 40; "
        "to 80 if the points are noisy",
        minimum=3,
    )
    orient: str = option(
        "auto",
        "which side is out. auto: the file's normals say where neighbours agree, else its sensors, else the place that "
        "all was seen from, if points are even as seen from the origin, or nothing lies behind anything else from "
        "there or from above, else wnnc; wnnc: by the winding number, for which all points vote, and by what "
        "neighbours agree on; mst: from neighbour to neighbour alone; file: as in the file; viewpoint: "
        "towards the sensor",
        choices=("auto", "wnnc", "mst", "file", "viewpoint"),
    )
    viewpoint: Position | None = option(
        None,
        "X,Y,Z of the sensor, in the units of the file, for `orient='viewpoint'`; default: each point's own, "
        "from the file's sensor_x, sensor_y and sensor_z, or array sensor",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.viewpoint is not None and self.orient != "viewpoint":
            raise UsageError(
                f"A viewpoint is of no use with orient {self.orient}.", "Add `orient='viewpoint'`, or leave it out."
            )
