# SPDX-License-Identifier: GPL-3.0-or-later
"""What some programs mean by the properties of their PLY files: cameras, Gaussian splats."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput
from hdpea.reading.cloud import SENSOR_NAMES

FIRST_HARMONIC = 0.28209479177387814
"""sqrt(1 / (4 pi)): a splat's colour is 1/2 plus this times ``f_dc`` (Kerbl et al. 2023, 3D Gaussian Splatting)."""

_SPLAT = {"f_dc_0", "f_dc_1", "f_dc_2", "opacity"}
_NOT_OF_A_CENTRE = ("f_dc_", "f_rest_", "scale_", "rot_")
_CAMERA = ("view_px", "view_py", "view_pz")


def meaning_of(elements: Mapping[str, Mapping[str, NDArray[Any]]], notes: list[str]) -> Mapping[str, NDArray[Any]]:
    """Return the columns (n,) of the vertices of a file by name, with what its other elements tell of them.

    Of Gaussian splats these are centres and colours; the one camera of a file, as MeshLab writes it, is the sensor.
    `notes` is added to.

    Raises
    ------
    UnreadableInput
        If the splats are packed.
    """
    vertex = elements["vertex"]
    if "packed_position" in vertex:
        raise UnreadableInput("its Gaussian splats are packed.", "splat-transform scan.compressed.ply scan.ply")
    if set(vertex) >= _SPLAT:
        notes.append("The file holds Gaussian splats; their centres are taken as points.")
        kept = {name: column for name, column in vertex.items() if not name.startswith(_NOT_OF_A_CENTRE)}
        colors = {
            name: np.clip(0.5 + FIRST_HARMONIC * vertex[f"f_dc_{i}"], 0, 1)
            for i, name in enumerate(("red", "green", "blue"))
        }
        return kept | colors
    camera = elements.get("camera", {})
    if all(name in camera and len(camera[name]) == 1 for name in _CAMERA) and any(camera[name][0] for name in _CAMERA):
        notes.append("The camera of the file is taken for the place of the sensor.")
        count = len(next(iter(vertex.values())))
        position = {
            name: np.full(count, float(camera[axis][0])) for name, axis in zip(SENSOR_NAMES, _CAMERA, strict=True)
        }
        return {**position, **vertex}
    return vertex
