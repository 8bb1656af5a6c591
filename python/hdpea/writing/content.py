# SPDX-License-Identifier: GPL-3.0-or-later
"""What is written of a mesh, in whatever format."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.texture import Texture
from hdpea.writing.placement import Placement


@dataclass(frozen=True)
class MeshContent:
    """A mesh that was checked.

    Attributes
    ----------
    vertices, faces
        (v, 3) float64 and (f, 3) int64.
    columns
        Attributes (v,) by name, in types of PLY.
    placement
        How the file holds the vertices.
    texture
        For OBJ and GLB.
    name
        The name of the file without its extension: what OBJ calls its material by.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    columns: Mapping[str, NDArray[Any]]
    placement: Placement
    texture: Texture | None = None
    name: str = "mesh"
