# SPDX-License-Identifier: GPL-3.0-or-later
"""What programs call the coordinates and the normals of points."""

from __future__ import annotations

import re
from collections.abc import Iterable

COORDINATE_NAMES = (
    ("x", "easting", "east", "e", "x_coord", "coord_x", "xcoord", "x_coordinate", "pos_x", "posx", "position_x", "px",
     "point_x", "points_0", "rechtswert"),
    ("y", "northing", "north", "n", "y_coord", "coord_y", "ycoord", "y_coordinate", "pos_y", "posy", "position_y",
     "py", "point_y", "points_1", "hochwert"),
    ("z", "elevation", "elev", "height", "h", "altitude", "z_coord", "coord_z", "zcoord", "z_coordinate", "pos_z",
     "posz", "position_z", "pz", "point_z", "points_2", "höhe", "hoehe"),
)  # fmt: skip
"""Of each axis, the likeliest first; ArcGIS has POINT_X, ParaView ``Points:0``, German surveyors Rechtswert."""

NORMAL_NAMES = (
    ("nx", "ny", "nz"),
    ("normal_x", "normal_y", "normal_z"),
    ("normalx", "normaly", "normalz"),
    ("normals_0", "normals_1", "normals_2"),
)

DEGREES = frozenset({"lon", "longitude", "long", "lng", "lat", "latitude"})


def plain_name(name: str) -> str:
    """Return a name without its case, its unit, and what CloudCompare puts before the names of scalar fields.

    Examples
    --------
    >>> plain_name(" Easting [m]"), plain_name("scalar_NormalX")
    ('easting', 'normalx')
    """
    bare = re.sub(r"[\[(].*", "", name).strip().lower()
    return re.sub(r"[\s.:-]+", "_", bare).removeprefix("scalar_")


def coordinates_among(names: Iterable[str]) -> tuple[str, ...]:
    """Return the names, as they are plain, of those of x, y and z that are there."""
    known = set(names)
    found = (next((name for name in axis if name in known), None) for axis in COORDINATE_NAMES)
    return tuple(name for name in found if name is not None)
