# SPDX-License-Identifier: GPL-3.0-or-later
"""The files that a mesh is written to: those beside it may be somebody's, too."""

from __future__ import annotations

from pathlib import Path

from hdpea.writing.obj import texture_files
from hdpea.writing.placement import placement_file


def level_path(path: Path, number: int) -> Path:
    """Return where a coarser level of the mesh at `path` is written: beside it, as mesh.lod1.obj for the first.

    Examples
    --------
    >>> level_path(Path("out/mesh.obj"), 2).as_posix()
    'out/mesh.lod2.obj'
    """
    return path.with_name(f"{path.stem}.lod{number}{path.suffix}")


def mesh_outputs(mesh: Path, *, textured: bool, placed: bool = True) -> list[tuple[Path, str]]:
    """Return the files that a mesh is written to, and the kind of each.

    Parameters
    ----------
    mesh
        The file of the mesh itself.
    textured
        Whether it has a texture, which lies beside an OBJ.
    placed
        Whether a file beside it says where it lies; default: yes, as may be before the mesh is known.
    """
    outputs = [(mesh, "mesh")]
    if placed:
        outputs.append((placement_file(mesh), "placement"))
    if textured and mesh.suffix.lower() == ".obj":
        outputs += [(path, kind) for kind, path in texture_files(mesh).items()]
    return outputs
