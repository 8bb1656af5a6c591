# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices that occur once for each smooth part of the surface around them, as renderers want them at creases."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.directions import directions_of
from hdpea.geometry.linked import first_linked
from hdpea.geometry.triangles import area_vectors

CREASE = 40.0
"""Dihedral angle in degrees beyond which two faces meet in a crease, as for creases of clouds."""

Corners = NDArray[np.int64]


def split_at_creases(vertices: NDArray[np.float64], faces: Corners) -> tuple[Corners, Corners]:
    """Return which vertex (m,) each of a mesh split along its creases was, and its faces (f, 3).

    Two faces share a vertex still if a way around it leads from one to the other across edges of at most
    ``CREASE`` degrees. Vertices without creases occur once, in their order; those of no face are left out.
    """
    first, second = _corners_joined(vertices, faces)
    keys = np.stack([faces.ravel(), first_linked(faces.size, first, second)], axis=1)
    fans, corners = np.unique(keys, axis=0, return_inverse=True)
    return fans[:, 0], corners.reshape(faces.shape)


def _corners_joined(vertices: NDArray[np.float64], faces: Corners) -> tuple[Corners, Corners]:
    """Return pairs (p,) of corners, numbered along ``faces.ravel()``, that lie on one vertex across a smooth edge."""
    lengths = abs(vertices).max(initial=0) or 1.0
    normals = directions_of(area_vectors(vertices / lengths, faces))
    starts = np.arange(faces.size)
    ends = starts - starts % 3 + (starts + 1) % 3
    ends_of = np.stack([faces.ravel()[starts], faces.ravel()[ends]], axis=1)
    low, high = ends_of.min(axis=1), ends_of.max(axis=1)
    order = np.lexsort((high, low))
    same = (low[order][1:] == low[order][:-1]) & (high[order][1:] == high[order][:-1])
    one, other = order[:-1][same], order[1:][same]
    smooth = (normals[one // 3] * normals[other // 3]).sum(axis=1) >= np.cos(np.radians(CREASE))
    one, other = one[smooth], other[smooth]
    # The two halves of an edge run in opposite directions, in an oriented mesh.
    return np.concatenate([starts[one], ends[one]]), np.concatenate([ends[other], starts[other]])
