# SPDX-License-Identifier: GPL-3.0-or-later
"""The angles of triangles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def triangle_angles(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the angles (f, 3) of triangles in degrees, at their corners; 0, 0 and 180 for a triangle without area.

    By the arctangent of cross and dot product, which is accurate for slivers, where the arccosine is not.
    """
    corners = vertices[faces]
    ahead, back = (np.roll(corners, shift, axis=1) - corners for shift in (-1, 1))
    sines = np.linalg.norm(np.cross(ahead, back), axis=2)
    return np.asarray(np.degrees(np.arctan2(sines, np.einsum("fkc,fkc->fk", ahead, back))))
