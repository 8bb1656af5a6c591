# SPDX-License-Identifier: GPL-3.0-or-later
"""What a reconstruction returns: the mesh, its levels of detail, and the report of how it was made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hdpea.frontend.cleaning import DroppedPoints
from hdpea.geometry.texture import Texture
from hdpea.report.report import Report
from hdpea.runtime.marks import check_replaceable
from hdpea.writing.meshes import write_mesh
from hdpea.writing.objects import as_open3d, as_pyvista, as_trimesh
from hdpea.writing.outputs import level_path, mesh_outputs
from hdpea.writing.placement import Placement

if TYPE_CHECKING:
    import pyvista
    import trimesh


@dataclass(frozen=True)
class Level:
    """A coarser version of a mesh: vertices (v, 3) in world units, faces (f, 3) and attributes, as of the mesh."""

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    attributes: Mapping[str, NDArray[Any]] = field(default_factory=dict)


@dataclass(frozen=True)
class Reconstruction:
    """A mesh, and the report of how it was made.

    Attributes
    ----------
    vertices
        (v, 3) float64 in world units.
    faces
        (f, 3) int64, counter-clockwise seen from outside. Edge- and vertex-manifold.
    report
        What was asked, chosen, found and measured.
    dropped
        The points that were left out because they show no surface, or crowd on scan lines.
    attributes
        Arrays (v,) or (v, c) by name: the attributes of the points at the vertices (``hdpea.mesh.attributes``); colours
        are red, green and blue, sRGB of 8 bits.
    crs
        The coordinate reference system of the vertices, if the cloud's is known.
    texture
        An image of the colours of the points and how it lies on the mesh, if it was asked for.
    levels
        Coarser versions, each made from the one before, if `options.meshing.lod` asks for them.
    """

    vertices: NDArray[np.float64]
    faces: NDArray[np.int64]
    report: Report
    dropped: DroppedPoints = field(default_factory=DroppedPoints)
    attributes: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    crs: str | None = None
    texture: Texture | None = None
    levels: tuple[Level, ...] = ()

    def write(self, path: str | Path, *, up: str | None = None, force: bool = False) -> None:
        """Write the mesh with its attributes, its texture and where it lies, as ``hdpea.write_mesh`` does.

        Its levels are written beside it, without the texture: those of mesh.obj are mesh.lod1.obj and so on.

        Raises
        ------
        UsageError
            As ``hdpea.write_mesh`` does, before anything is written: no file that hdpea did not make is replaced,
            unless by `force`.
        """
        path = Path(path)
        check_replaceable(self._outputs(path), force)
        write_mesh(path, self.vertices, self.faces, self.attributes, self.crs, self.texture, up=up, force=force)
        for number, level in enumerate(self.levels, start=1):
            beside = level_path(path, number)
            write_mesh(beside, level.vertices, level.faces, level.attributes, self.crs, up=up, force=force)

    def _outputs(self, path: Path) -> dict[Path, str]:
        """Return all files that ``write`` writes, and the kind of each."""
        meshes: dict[Path, Reconstruction | Level] = {path: self}
        meshes |= {level_path(path, number): level for number, level in enumerate(self.levels, start=1)}
        outputs = dict[Path, str]()
        for each, mesh in meshes.items():
            placed = Placement.of(mesh.vertices, mesh.faces, path.suffix.lower(), self.crs, up="z").is_worth_a_file()
            outputs |= mesh_outputs(each, textured=each == path and self.texture is not None, placed=placed)
        return outputs

    def to_trimesh(self) -> trimesh.Trimesh:
        """Return it with colours, the other attributes as ``vertex_attributes``."""
        return as_trimesh(self.vertices, self.faces, self.attributes)

    def to_open3d(self) -> Any:
        """Return an ``open3d.geometry.TriangleMesh`` with normals and colours.

        Raises
        ------
        UsageError
            If Open3D is not installed.
        """
        return as_open3d(self.vertices, self.faces, self.attributes)

    def to_pyvista(self) -> pyvista.PolyData:
        """Return it with colours as ``RGB`` and the other attributes, in its ``point_data``.

        Raises
        ------
        UsageError
            If PyVista is not installed.
        """
        return as_pyvista(self.vertices, self.faces, self.attributes)
