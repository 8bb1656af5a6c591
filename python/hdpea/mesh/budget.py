# SPDX-License-Identifier: GPL-3.0-or-later
"""The number of vertices or faces that is wanted, and by how much a mesh misses it."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.mesh.extraction import Mesh
from hdpea.options import MeshingOptions, Options
from hdpea.options.choice import Choice
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.options.points_shown import PointsShown

TOLERANCE = 0.01
"""Relative difference from the number asked for that is tolerated; one vertex, or face, always is."""


@dataclass(frozen=True)
class Budget:
    """Vertices, or faces, that a mesh is to have; None if any number will do."""

    asked: int | None
    counts_faces: bool

    @classmethod
    def of(cls, options: MeshingOptions) -> Budget:
        """Return what the options ask for."""
        return cls(options.vertices if options.faces is None else options.faces, options.faces is not None)

    def excess(self, mesh: Mesh) -> float:
        """Return by what share of the number asked for the mesh exceeds it.

        Negative if it has too few; 0 within the tolerance.
        """
        if self.asked is None:
            return 0.0
        more = self._made(mesh) - self.asked
        return more / self.asked if abs(more) > max(TOLERANCE * self.asked, 1) else 0.0

    def comparison(self, mesh: Mesh) -> str:
        """Say in a sentence what was asked for, and what the mesh has."""
        what = "faces" if self.counts_faces else "vertices"
        return f"{self.asked:,} {what} were asked for, and the mesh has {self._made(mesh):,}."

    def _made(self, mesh: Mesh) -> int:
        return len(mesh.faces if self.counts_faces else mesh.vertices_in_unit)


def particles_wanted(options: Options, points: int, shown: PointsShown) -> tuple[int, tuple[Choice, ...]]:
    """Return how many particles to spread on so many points, and what was chosen for that.

    Raises
    ------
    UsageError
        If there are fewer points than that.
    """
    vertices, given = options.vertices_of(shown.count), options.particles.particles
    asked = vertices if given is None else given
    if asked > points:
        what = "vertices" if asked == vertices else "particles"
        raise UsageError(
            f"{asked} {what} were asked for, but there are {points} distinct points on the surface.",
            f"Ask for at most half as many {what} as there are points.",
        )
    particles = options.particles_of(points, shown)
    if given is not None:
        return particles, ()
    choices = list[Choice]()
    if options.meshing.any_size and options.meshing.error is None:
        choices.append(Choice("vertices", vertices, "", f"one for every {POINTS_PER_VERTEX} points"))
    why = "as many as vertices: the points can hardly show more"
    if particles > vertices or options.meshing.error is not None:
        why = f"spread on {shown.count:,} points; the mesh is simplified from these"
    choices.append(Choice("particles", particles, "", why))
    return particles, tuple(choices)
