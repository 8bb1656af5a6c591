# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and embedded points to files, without losing a digit the format can hold."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
from numpy.lib.recfunctions import repack_fields
from numpy.typing import ArrayLike, NDArray
from plyfile import PlyData, PlyElement

from hdpea.errors import UsageError
from hdpea.geometry.unit_frame import diagonal_of
from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.marking import marked, save_arrays

Points = NDArray[np.float64]
Faces = NDArray[np.int64]

FLOAT32_LOSS = 1e-6
"""Largest share of the diagonal that a vertex may move by being stored in single precision."""

FLOAT32_LEAST, FLOAT32_MOST = 1e-30, 1e30
"""Sizes of meshes between which single precision has all its digits for their details, too."""


def write_mesh(path: str | Path, vertices: ArrayLike, faces: ArrayLike) -> None:
    """Write a triangle mesh as OBJ, PLY, OFF, STL or GLB, by the extension of `path`.

    OBJ, PLY and OFF hold the vertices exactly. STL is binary, or text where single precision would
    move the vertices of a georeferenced mesh. GLB is shifted to its centre, and scaled if single precision could not
    hold its size; its node holds the shift and the scale.

    Parameters
    ----------
    path
        Replaced only once the new file is complete.
    vertices
        (v, 3), finite.
    faces
        (f, 3) indices of vertices.

    Raises
    ------
    UsageError
        If the file cannot be written, or the arrays are no mesh.
    """
    path = Path(path)
    check_output(path, MESH_FORMATS)
    content = mesh_content(path.suffix.lower(), vertices, faces)
    with replacing(path) as partial:
        partial.write_bytes(content)


def mesh_content(extension: str, vertices: ArrayLike, faces: ArrayLike) -> bytes:
    """Return what ``write_mesh`` writes, for an extension of ``MESH_FORMATS``.

    Raises
    ------
    UsageError
        If the arrays are no mesh.
    """
    return marked(MESH_FORMATS[extension](*_checked(vertices, faces)), extension)


def _checked(vertices: ArrayLike, faces: ArrayLike) -> tuple[Points, Faces]:
    """Return the arrays of a mesh in their types."""
    hint = "Vertices are numbers of shape (v, 3), faces indices of them of shape (f, 3)."
    rows, corners = np.asarray(vertices), np.asarray(faces)
    for name, array, kinds in (("vertices", rows, "fiu"), ("faces", corners, "iu")):
        if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in kinds:
            raise UsageError(f"The {name} are {array.dtype} of shape {array.shape}.", hint)
    if not np.isfinite(rows).all():
        raise UsageError("Not all vertices are finite.", hint)
    if corners.size and not 0 <= corners.min() <= corners.max() < len(rows):
        raise UsageError("A face has a corner that is no vertex.", hint)
    return rows.astype(np.float64), corners.astype(np.int64)


def write_points(path: Path, points: Points, normals: Points, coordinates: Points) -> None:
    """Write embedded points as NPZ (arrays of these names) or PLY (embedding_0 to embedding_7).

    Parameters
    ----------
    path
        Replaced only once the new file is complete.
    points, normals
        (n, 3) float64.
    coordinates
        (n, 8) float64, the embedding.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    check_output(path, POINT_FORMATS)
    with replacing(path) as partial:
        if path.suffix.lower() == ".npz":
            save_arrays(partial, "embedding", points=points, normals=normals, coordinates=coordinates)
        else:
            others = {f"embedding_{i}": column for i, column in enumerate(coordinates.T)}
            partial.write_bytes(point_ply(points, normals, others, "embedding"))


def point_ply(points: Points, normals: Points, others: Mapping[str, NDArray[np.float64]], kind: str = "scan") -> bytes:
    """Return the content of a PLY file of points (n, 3), normals (n, 3) and other properties (n,), marked as `kind`."""
    table = np.column_stack([points, normals, *others.values()])
    return marked(_ply(_records(table, ["x", "y", "z", "nx", "ny", "nz", *others])), ".ply", kind)


def _obj(vertices: Points, faces: Faces) -> bytes:
    return _lines(vertices, "v ") + _lines(faces + 1, "f ")


def _off(vertices: Points, faces: Faces) -> bytes:
    return f"OFF\n{len(vertices)} {len(faces)} 0\n".encode() + _lines(vertices) + _lines(faces, "3 ")


def _lines(rows: Points | Faces, prefix: str = "") -> bytes:
    # repr is the shortest text that reads back as the same number.
    return "".join(f"{prefix}{' '.join(map(repr, row))}\n" for row in rows.tolist()).encode()


def _ply(vertex: NDArray[np.void], faces: Faces | None = None) -> bytes:
    elements, body = [PlyElement.describe(vertex, "vertex")], vertex.tobytes()
    if faces is not None:
        # The library writes lists one by one; every list here is three long, which makes it a table.
        table = np.empty(len(faces), [("count", "u1"), ("vertex_indices", "<i4", 3)])
        table["count"], table["vertex_indices"] = 3, faces
        body += table.tobytes()
        elements.append(PlyElement.describe(repack_fields(table[["vertex_indices"]]), "face"))
    header: str = PlyData(elements, byte_order="<").header
    return f"{header}\n".encode() + body


def _records(table: Points, names: list[str]) -> NDArray[np.void]:
    return np.ascontiguousarray(table, "<f8").view([(name, "<f8") for name in names])[:, 0]


def _stl(vertices: Points, faces: Faces) -> bytes:
    import trimesh  # takes a second, which the other formats need not wait for

    mesh = trimesh.Trimesh(vertices, faces, process=False)
    # What is too large for single precision is infinitely far off.
    with np.errstate(all="ignore"):
        loss = abs(vertices - vertices.astype(np.float32)).max(initial=0)
        if loss > FLOAT32_LOSS * diagonal_of(*_bounds(vertices)):
            return trimesh.exchange.stl.export_stl_ascii(mesh).encode()
        return trimesh.exchange.stl.export_stl(mesh)


def _bounds(vertices: Points) -> tuple[Points, Points]:
    """Return the lowest and the highest corner (3,) of the bounding box; that of nothing is the origin."""
    return (vertices.min(axis=0), vertices.max(axis=0)) if len(vertices) else (np.zeros(3), np.zeros(3))


def _glb(vertices: Points, faces: Faces) -> bytes:
    import trimesh

    lowest, highest = _bounds(vertices)
    center, extent = lowest / 2 + highest / 2, diagonal_of(lowest, highest)
    # A power of two, by which scaling loses nothing.
    scale = 1.0 if FLOAT32_LEAST < extent < FLOAT32_MOST else 2.0 ** math.frexp(extent)[1]
    transform = np.diag([scale, scale, scale, 1.0])
    transform[:3, 3] = center
    scene = trimesh.Scene()
    scene.add_geometry(
        trimesh.Trimesh((vertices - center) / scale, faces, process=False),
        node_name="mesh",
        geom_name="mesh",
        transform=transform,
    )
    content: bytes = trimesh.exchange.gltf.export_glb(scene)
    return content


MESH_FORMATS: dict[str, Callable[[Points, Faces], bytes]] = {
    ".obj": _obj,
    ".ply": lambda vertices, faces: _ply(_records(vertices, ["x", "y", "z"]), faces),
    ".off": _off,
    ".stl": _stl,
    ".glb": _glb,
}
POINT_FORMATS = (".npz", ".ply")
