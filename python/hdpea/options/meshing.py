# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of the extraction of a mesh, and the number of its vertices or faces."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options.checked import Checked, option
from hdpea.options.lengths import Length

POINTS_PER_VERTEX = 8
"""Points per vertex unless a number of vertices or faces is asked for."""


@dataclass(frozen=True)
class MeshingOptions(Checked):
    """How the particles become a mesh (``hdpea.mesh.extraction``)."""

    vertices: int | None = option(
        None, f"vertices wanted; default: one for every {POINTS_PER_VERTEX} points, fewer if these are noisy", minimum=4
    )
    faces: int | None = option(None, "faces wanted, instead of `vertices`", minimum=4)
    error: Length | None = option(
        None,
        "make as few triangles as keep within this of the points, both ways, as 0.02 or 0.5%; `vertices` or `faces` "
        "are then the most there may be",
    )
    lod: int = option(
        1,
        "levels of detail to write, as mesh.obj, mesh.lod1.obj and so on: each is made from the one before, and has "
        "half its faces or, with `error`, may be twice as far from the points",
        minimum=1,
        maximum=16,
    )
    fill_holes: Length | None = option(
        None,
        "fill holes up to this size across, as 0.02 or 1%; default: 4 times the spacing of one vertex for every "
        f"{POINTS_PER_VERTEX} points, or of those wanted if they are more; 0: none",
    )
    watertight: bool = option(False, "close every hole, whatever its size")
    min_component: int = option(
        16,
        "drop connected pieces of fewer faces than this, or of as small a share of the mesh that is to be simplified; "
        "the largest stays",
        minimum=0,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.vertices is not None and self.faces is not None:
            raise UsageError("Vertices and faces exclude each other.", "Ask for one; the other follows from it.")
        if self.error is not None and self.error.value == 0:
            raise UsageError("No mesh of fewer triangles has an `error` of 0.", "Such as 0.5% of the diagonal.")

    @property
    def any_size(self) -> bool:
        """Whether the mesh need not have any number of vertices or faces: with an error it is only the most."""
        return self.error is not None or (self.vertices is None and self.faces is None)

    def vertices_of(self, points: int) -> int:
        """Return how many vertices to make of so many points: a closed mesh has two faces for each."""
        if self.error is None and self.vertices is not None:
            return self.vertices
        if self.error is None and self.faces is not None:
            return self.faces // 2 + 2
        return max(points // POINTS_PER_VERTEX, 12)
