# SPDX-License-Identifier: GPL-3.0-or-later
"""Where in the world a mesh lies: its coordinate reference system, and a shift where single precision asks for one."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.geometry.unit_frame import diagonal_of
from hdpea.geometry.upright import upright_axis
from hdpea.runtime.marks import is_marked, mark_of
from hdpea.runtime.outputs import replacing

FLOAT32_LOSS = 1e-6
"""Largest share of the diagonal that a vertex may move by being stored in single precision."""

AS_THEY_ARE = ["shift[0] + x", "shift[1] + y", "shift[2] + z"]
"""World coordinates of a file's x, y and z, where only a shift lies between."""

OF_GLTF = {
    "z": ["shift[0] + x", "shift[1] - z", "shift[2] + y"],
    "y": AS_THEY_ARE,
    "-y": ["shift[0] + x", "shift[1] - y", "shift[2] - z"],
}
"""The same of a GLB, in which y is up, by what is up in the world."""


@dataclass(frozen=True)
class Placement:
    """How the coordinates in a file are to be understood.

    Attributes
    ----------
    shift
        (3,) in world units: what was subtracted from the coordinates.
    up
        Which axis of the file is up, if that is known: y in GLB.
    world_up
        Which axis of the world that is, by its name in ``hdpea.geometry.upright``.
    crs
        The coordinate reference system, as WKT or such as EPSG:25832, if it is known.
    """

    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    up: str | None = None
    world_up: str | None = None
    crs: str | None = None

    @classmethod
    def of(
        cls,
        vertices: NDArray[np.float64],
        faces: NDArray[np.int64],
        extension: str,
        crs: str | None = None,
        up: str | None = None,
    ) -> Placement:
        """Return how a file of this extension, such as ``.glb``, holds a mesh (v, 3), (f, 3).

        `up` is the axis that is up in the world; default: z where the `crs` is known, else what the shape shows.
        """
        if extension != ".glb":
            return cls(crs=crs)
        world_up = up or ("z" if crs is not None or not len(faces) else upright_axis(vertices, faces))
        return cls(single_precision_shift(vertices), "y", world_up, crs)

    def is_worth_a_file(self) -> bool:
        """Say whether a program that reads the mesh alone would not know where it lies."""
        return self.crs is not None or any(self.shift)

    def as_dict(self) -> dict[str, Any]:
        """Return it fit for JSON, with how to get back."""
        return {
            "generator": mark_of("placement"),
            "crs": self.crs,
            "shift": list(self.shift),
            "up": self.up or "z",
            "world_up": self.world_up or "z",
            "unit": "metre" if self.crs is None else "that of the crs",
            "world": OF_GLTF[self.world_up] if self.world_up else AS_THEY_ARE,
        }


def single_precision_shift(vertices: NDArray[np.float64]) -> tuple[float, float, float]:
    """Return what to subtract from vertices (v, 3) before they are stored in 32 bits: a short number, mostly 0."""
    if not loses_digits(vertices):
        return (0.0, 0.0, 0.0)
    lowest, highest = vertices.min(axis=0), vertices.max(axis=0)
    extent = diagonal_of(lowest, highest)
    step = 10.0 ** math.floor(math.log10(extent)) if 0 < extent < math.inf else 1.0
    x, y, z = (np.rint((lowest / 2 + highest / 2) / step) * step).tolist()
    return (x, y, z)


def loses_digits(vertices: NDArray[np.float64]) -> bool:
    """Say whether 32 bits would move vertices (v, 3) visibly; what is too large for them is infinitely far off."""
    if not len(vertices):
        return False
    with np.errstate(all="ignore"):
        loss = abs(vertices - vertices.astype(np.float32)).max()
    return bool(loss > FLOAT32_LOSS * diagonal_of(vertices.min(axis=0), vertices.max(axis=0)))


def placement_file(mesh: Path) -> Path:
    """Return the name of the file beside a mesh that says where it lies."""
    return mesh.with_name(f"{mesh.name}.world.json")


def write_placement(mesh: Path, placement: Placement) -> None:
    """Write where a mesh lies into the JSON file beside it; if there is nothing to say, remove that of an earlier mesh.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    beside = placement_file(mesh)
    if placement.is_worth_a_file():
        with replacing(beside) as partial:
            partial.write_text(json.dumps(placement.as_dict(), indent=2) + "\n")
    elif beside.is_file() and is_marked(beside, "placement"):
        beside.unlink()
