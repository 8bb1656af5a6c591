# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes to files, without losing a digit the format can hold."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.errors import UsageError
from hdpea.geometry.texture import Texture
from hdpea.geometry.upright import GLTF_FROM_WORLD
from hdpea.runtime.marks import check_replaceable
from hdpea.runtime.outputs import check_output, replacing
from hdpea.writing.attributes import colors_of, columns_of
from hdpea.writing.content import MeshContent
from hdpea.writing.glb import glb
from hdpea.writing.marking import marked
from hdpea.writing.obj import lines, obj, png, write_texture_files
from hdpea.writing.outputs import mesh_outputs
from hdpea.writing.placement import Placement, loses_digits, write_placement
from hdpea.writing.ply import mesh_ply

Points = NDArray[np.float64]
Faces = NDArray[np.int64]

TEXTURED_FORMATS = (".obj", ".glb")


def write_mesh(
    path: str | Path,
    vertices: ArrayLike,
    faces: ArrayLike,
    attributes: Mapping[str, ArrayLike] | None = None,
    crs: str | None = None,
    texture: Texture | None = None,
    *,
    up: str | None = None,
    force: bool = False,
) -> None:
    """Write a triangle mesh as OBJ, PLY, OFF, STL or GLB, by the extension of `path`.

    OBJ, PLY and OFF hold the vertices exactly. STL is binary, or text where single precision would
    move the vertices of a georeferenced mesh. GLB has y up, counts in metres, and is scaled if single precision could
    not hold its size; a georeferenced mesh is shifted there. Shift and `crs` are written beside the mesh, as
    ``mesh.glb.world.json``, if there are any, and into the extras of the GLB's node.

    Parameters
    ----------
    path
        Replaced only once the new file is complete.
    vertices
        (v, 3), finite.
    faces
        (f, 3) indices of vertices.
    attributes
        (v,) or (v, c) by name. PLY holds all of them, OBJ and GLB the colours (red, green and blue of 8 bits), OFF and
        STL none.
    crs
        The coordinate reference system of the vertices, as WKT or such as ``EPSG:25832``.
    texture
        For OBJ and GLB, which then have no vertex colours. That of ``mesh.obj`` is written beside it, as ``mesh.mtl``
        and ``mesh.texture.png``.
    up
        GLB: the axis of the vertices that is up, ``"z"``, ``"y"`` or ``"-y"``, as before a depth camera; default: z
        where `crs` is known, else the one that the shape shows (``hdpea.geometry.upright``).
    force
        Whether a file that hdpea did not make may be replaced, be it the mesh or one beside it.

    Raises
    ------
    UsageError
        If the file cannot be written or may not be replaced, the arrays are no mesh, or the format holds no texture.
    """
    path = Path(path)
    check_output(path, MESH_FORMATS)
    extension = path.suffix.lower()
    content, placement = mesh_content(extension, vertices, faces, attributes, crs, texture, path.stem, up)
    outputs = mesh_outputs(path, textured=texture is not None, placed=placement.is_worth_a_file())
    check_replaceable(dict(outputs), force)
    if texture is not None and extension == ".obj":
        write_texture_files(path, texture)
    with replacing(path) as partial:
        partial.write_bytes(content)
    write_placement(path, placement)


def mesh_content(
    extension: str,
    vertices: ArrayLike,
    faces: ArrayLike,
    attributes: Mapping[str, ArrayLike] | None = None,
    crs: str | None = None,
    texture: Texture | None = None,
    name: str = "mesh",
    up: str | None = None,
) -> tuple[bytes, Placement]:
    """Return what ``write_mesh`` writes, for an extension of ``MESH_FORMATS``, and where it stands in the world.

    `name` is what a textured OBJ calls its material file by.

    Raises
    ------
    UsageError
        If the arrays are no mesh.
    """
    checked_vertices, checked_faces = _checked(vertices, faces)
    columns = columns_of(attributes or {}, len(checked_vertices))
    placement = Placement.of(checked_vertices, checked_faces, extension, crs, up)
    check_textured(extension, texture is not None)
    content = MeshContent(checked_vertices, checked_faces, columns, placement, texture, name)
    return marked(MESH_FORMATS[extension](content), extension), placement


def check_textured(extension: str, textured: bool) -> None:
    """Make sure that a format holds a texture, if there is one.

    Raises
    ------
    UsageError
        If it does not.
    """
    if textured and extension not in TEXTURED_FORMATS:
        raise UsageError(f"{extension[1:].upper()} holds no `texture`.", "Write OBJ or GLB.")


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


def _off(mesh: MeshContent) -> bytes:
    head = f"OFF\n{len(mesh.vertices)} {len(mesh.faces)} 0\n".encode()
    return head + lines(mesh.vertices) + lines(mesh.faces, "3 ")


def _stl(content: MeshContent) -> bytes:
    import trimesh  # takes a second, which the other formats need not wait for

    mesh = trimesh.Trimesh(content.vertices, content.faces, process=False)
    if loses_digits(content.vertices):
        return trimesh.exchange.stl.export_stl_ascii(mesh).encode()
    with np.errstate(all="ignore"):
        return trimesh.exchange.stl.export_stl(mesh)


def _glb(mesh: MeshContent) -> bytes:
    shifted, extras = mesh.vertices - mesh.placement.shift, mesh.placement.as_dict()
    turned = shifted @ GLTF_FROM_WORLD[mesh.placement.world_up or "z"].T
    if mesh.texture is None:
        return glb(turned, mesh.faces, colors_of(mesh.columns), extras=extras)
    return glb(turned, mesh.faces, texture=mesh.texture, image=png(mesh.texture), extras=extras)


MESH_FORMATS: dict[str, Callable[[MeshContent], bytes]] = {
    ".obj": obj,
    ".ply": mesh_ply,
    ".off": _off,
    ".stl": _stl,
    ".glb": _glb,
}
