# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of a finished mesh is out, where nothing but the points said so: a piece that is closed has an inside."""

from __future__ import annotations

from dataclasses import dataclass, replace

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.mesh.extraction import Mesh

MOST_GUESSED = 0.25
"""Largest share of the area without an inside that is not worth a note."""

ROOM = "a guess; in a room that was scanned from within, give sensors, or of a single place `orient` and `viewpoint`"
"""What decides which of both it is: points on closed surfaces within each other look alike from either side."""


@dataclass(frozen=True)
class FacedMesh:
    """A mesh whose closed pieces face out, and sentences for the user about the others."""

    mesh: Mesh
    notes: tuple[str, ...] = ()


def facing_out(mesh: Mesh) -> FacedMesh:
    """Turn the closed pieces of a mesh that are inside out, but for those within another that is as good as closed.

    For normals whose side was computed: beside an open surface, neither the winding number nor a spanning tree knows
    the side of a closed one. What lies within a closed piece, or one of small gaps, may be the wall of a cavity, which
    faces into that; what lies in an open one is a thing in a bowl. Or all is a room with a thing in it, the other way
    round, which a note asks.
    """
    with core_errors_translated():
        faced = _core.face_outwards(mesh.vertices_in_unit, mesh.faces)
    notes = list[str]()
    if faced.sideless > MOST_GUESSED:
        notes.append("The surface is open: which side is out is a guess, unless `orient` and `viewpoint` say so.")
    if faced.within:
        notes.append(f"{_pieces(faced.within, 'lies', 'lie')} within another, facing inwards as cavities do: {ROOM}.")
    statistics = mesh.statistics | {"pieces_turned": faced.turned}
    return FacedMesh(replace(mesh, faces=faced.faces, statistics=statistics), tuple(notes))


def facing_as_given(mesh: Mesh) -> FacedMesh:
    """Leave the sides of a mesh as the normals of its points have them, and say which closed pieces are inside out.

    A room that was scanned from within is; of a thing, all normals of the file may have the wrong sign.
    """
    with core_errors_translated():
        inside_out = _core.face_outwards(mesh.vertices_in_unit, mesh.faces).turned
    if not inside_out:
        return FacedMesh(mesh)
    some = _pieces(inside_out, "faces", "face")
    return FacedMesh(mesh, (f"{some} inwards, as the given normals do: `orient` wnnc turns such outwards.",))


def _pieces(count: int, one_does: str, many_do: str) -> str:
    return f"A closed piece {one_does}" if count == 1 else f"{count:,} closed pieces {many_do}"
