# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes as the objects of other libraries, which are imported only here, when they are asked for."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UsageError
from hdpea.geometry.color import RGB
from hdpea.geometry.triangles import vertex_normals
from hdpea.writing.attributes import colors_of

if TYPE_CHECKING:
    import pyvista
    import trimesh

Points = NDArray[np.float64]
Faces = NDArray[np.int64]
Attributes = Mapping[str, NDArray[Any]]


def as_trimesh(vertices: Points, faces: Faces, attributes: Attributes) -> trimesh.Trimesh:
    """Return a ``trimesh.Trimesh`` with vertex colours; other attributes are its ``vertex_attributes``."""
    library, colors = _imported("trimesh"), colors_of(attributes)
    mesh: trimesh.Trimesh = library.Trimesh(vertices, faces, process=False, vertex_colors=colors)
    mesh.vertex_attributes.update(_beside_colors(attributes))
    return mesh


def as_open3d(vertices: Points, faces: Faces, attributes: Attributes) -> Any:
    """Return an ``open3d.geometry.TriangleMesh`` with normals and colours: it has room for no other attributes."""
    library, colors = _imported("open3d"), colors_of(attributes)
    rows = library.utility.Vector3dVector
    mesh = library.geometry.TriangleMesh(rows(vertices), library.utility.Vector3iVector(faces.astype(np.int32)))
    mesh.vertex_normals = rows(vertex_normals(vertices, faces))
    if colors is not None:
        mesh.vertex_colors = rows(colors / 255.0)
    return mesh


def as_pyvista(vertices: Points, faces: Faces, attributes: Attributes) -> pyvista.PolyData:
    """Return a ``pyvista.PolyData`` with colours as ``RGB`` and the other attributes, all in its ``point_data``."""
    library, colors = _imported("pyvista"), colors_of(attributes)
    mesh: pyvista.PolyData = library.PolyData.from_regular_faces(vertices, faces)
    arrays = {**_beside_colors(attributes), **({} if colors is None else {"RGB": colors})}
    for name, values in arrays.items():
        mesh.point_data[name] = values
    return mesh


def _beside_colors(attributes: Attributes) -> dict[str, NDArray[Any]]:
    return {name: values for name, values in attributes.items() if name not in RGB}


def _imported(library: str) -> Any:
    try:
        return import_module(library)
    except ImportError as error:
        raise UsageError(f"There is no {library} here: {error}.", f"pip install {library}") from error
