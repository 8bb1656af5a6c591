# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of a finished mesh is out, where nothing but the points said so: a piece that is closed has an inside."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.linked import first_linked
from hdpea.geometry.triangles import area_vectors, opposite_faces
from hdpea.mesh.extraction import Mesh

MOST_GUESSED = 0.25
"""Largest share of the area without an inside that is not worth a note."""

MOST_BORDER = 0.25
"""Length of its borders, in square roots of its area, up to which a piece with gaps is as good as closed.

A ball whose hole is a seventh of its radius wide has 0.25; a box without its lid has 1.8, half a ball 2.5."""


@dataclass(frozen=True)
class FacedMesh:
    """A mesh whose closed pieces face out, and sentences for the user about the others."""

    mesh: Mesh
    notes: tuple[str, ...] = ()


def facing_out(mesh: Mesh) -> FacedMesh:
    """Turn the closed pieces of a mesh that are inside out, but for those within another closed piece.

    For normals whose side was computed: beside an open surface, neither the winding number nor a spanning tree knows
    the side of a closed one. What lies within a closed piece may be the wall of a cavity, which faces into that; what
    lies in an open one is a thing in a bowl.
    """
    vertices, faces = mesh.vertices_in_unit, mesh.faces.copy()
    hold = _are_as_good_as_closed(mesh)
    with core_errors_translated():
        whole = _core.face_outwards(vertices, faces)
        held = whole if hold.all() else _core.face_outwards(vertices, np.ascontiguousarray(faces[hold]))
    faces[hold] = held.faces
    guess = "The surface is open: which side is out is a guess, unless `orient` and `viewpoint` say so."
    notes = (guess,) if whole.sideless > MOST_GUESSED else ()
    return FacedMesh(replace(mesh, faces=faces, statistics=mesh.statistics | {"pieces_turned": held.turned}), notes)


def _are_as_good_as_closed(mesh: Mesh) -> NDArray[np.bool_]:
    """Return of which faces (f,) the piece has no borders, but for those of small gaps."""
    vertices, faces = mesh.vertices_in_unit, mesh.faces
    face, side = np.nonzero(opposite_faces(faces) < 0)
    if not len(face):
        return np.ones(len(faces), dtype=bool)
    first, second, third = faces.T
    pieces = first_linked(len(vertices), np.r_[first, second], np.r_[second, third])[first]
    lengths = np.linalg.norm(vertices[faces[face, side]] - vertices[faces[face, (side + 1) % 3]], axis=1)
    borders = np.bincount(pieces[face], lengths, len(vertices))
    areas = np.bincount(pieces, np.linalg.norm(area_vectors(vertices, faces), axis=1), len(vertices))
    return np.asarray((borders <= MOST_BORDER * np.sqrt(areas))[pieces])
