# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of a finished mesh is out, where nothing but the points said so: a piece that is closed has an inside."""

from __future__ import annotations

from dataclasses import dataclass, replace

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.mesh.extraction import Mesh

MOST_GUESSED = 0.25
"""Largest share of the area without an inside that is not worth a note."""


@dataclass(frozen=True)
class FacedMesh:
    """A mesh whose closed pieces face out, and sentences for the user about the others."""

    mesh: Mesh
    notes: tuple[str, ...] = ()


def facing_out(mesh: Mesh) -> FacedMesh:
    """Turn the closed pieces of a mesh that are inside out, but for those within another that is as good as closed.

    For normals whose side was computed: beside an open surface, neither the winding number nor a spanning tree knows
    the side of a closed one. What lies within a closed piece, or one of small gaps, may be the wall of a cavity, which
    faces into that; what lies in an open one is a thing in a bowl.
    """
    with core_errors_translated():
        faced = _core.face_outwards(mesh.vertices_in_unit, mesh.faces)
    guess = "The surface is open: which side is out is a guess, unless `orient` and `viewpoint` say so."
    notes = (guess,) if faced.sideless > MOST_GUESSED else ()
    statistics = mesh.statistics | {"pieces_turned": faced.turned}
    return FacedMesh(replace(mesh, faces=faced.faces, statistics=statistics), notes)


def facing_as_given(mesh: Mesh) -> FacedMesh:
    """Leave the sides of a mesh as the normals of its points have them, and say which closed pieces are inside out.

    A room that was scanned from within is; of a thing, all normals of the file may have the wrong sign.
    """
    with core_errors_translated():
        inside_out = _core.face_outwards(mesh.vertices_in_unit, mesh.faces).turned
    if not inside_out:
        return FacedMesh(mesh)
    some = "A closed piece faces" if inside_out == 1 else f"{inside_out:,} closed pieces face"
    return FacedMesh(mesh, (f"{some} inwards, as the given normals do: `orient` wnnc turns such outwards.",))
