# SPDX-License-Identifier: GPL-3.0-or-later
"""Points in the objects of other libraries, told by what they have: none of these libraries is imported.

Open3D's clouds and meshes (of tensors, too), trimesh's, PyVista's, PDAL's structured arrays, tables of pandas.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

PointsLike = Any
"""An array (n, 3), a tensor, a cloud as ``hdpea.read`` returns it, or what ``parts_of`` knows."""

Arrays = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Parts:
    """What an object says of its points.

    Attributes
    ----------
    arrays
        Arrays of n rows by name: ``points`` (n, 3), ``normals`` if there are any; or columns such as x, y and z.
    is_mesh
        Whether the points are the vertices of faces.
    """

    arrays: Arrays
    is_mesh: bool = False

    @property
    def is_table(self) -> bool:
        """Whether the arrays are columns."""
        return "points" not in self.arrays


def as_array(values: Any) -> NDArray[Any]:
    """Return the array of anything that has one; a tensor may be on a GPU, or want a gradient."""
    for method in ("detach", "cpu", "numpy"):
        if hasattr(values, method) and not isinstance(values, np.ndarray):
            values = getattr(values, method)()
    return np.asarray(values)


def parts_of(given: Any) -> Parts | None:
    """Return what an object of another library says of its points; None if it is none, but maybe an array."""
    if hasattr(given, "to_records"):  # pandas
        given = given.to_records(index=False)
    if isinstance(given, np.ndarray):
        return None if given.dtype.names is None else Parts(_columns_of(given))
    tensors: Any
    for tensors in (getattr(given, "point", {}), getattr(given, "vertex", {})):  # Open3D, of tensors
        if "positions" in tensors:
            arrays = dict(tensors.items())
            return Parts(_named(arrays.pop("positions"), arrays), hasattr(given, "triangle"))
    if hasattr(given, "points"):  # PyVista; Open3D
        others = {name: getattr(given, name, ()) for name in ("normals", "colors")}
        others = dict(getattr(given, "point_data", others).items())
        return Parts(_named(given.points, others), len(getattr(given, "faces", ())) > 0)
    if hasattr(given, "vertices"):  # trimesh; meshes of Open3D
        others = {**getattr(given, "vertex_attributes", {}), "normals": getattr(given, "vertex_normals", ())}
        visual = getattr(given, "visual", given)
        # trimesh has grey ones where none were given.
        if getattr(visual, "kind", "vertex") == "vertex":
            others["colors"] = getattr(visual, "vertex_colors", ())
        return Parts(_named(given.vertices, others), hasattr(given, "faces") or hasattr(given, "triangles"))
    return None


def _named(points: Any, others: Mapping[str, Any]) -> Arrays:
    """Return points and those of the other arrays that have as many rows: empty ones are how libraries say none."""
    rows = as_array(points)
    arrays = {name: as_array(values) for name, values in others.items()}
    found = {name: values for name, values in arrays.items() if values.shape[:1] == rows.shape[:1]}
    if "Normals" in found:  # PyVista
        found["normals"] = found.pop("Normals")
    return found | {"points": rows}


def _columns_of(table: NDArray[np.void]) -> Arrays:
    """Return the fields of a structured array; PDAL's names, such as ReturnNumber, become those of other files."""
    words = {name: re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower() for name in table.dtype.names or ()}
    return {word: table[name] for name, word in words.items()}
