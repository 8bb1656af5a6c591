# SPDX-License-Identifier: GPL-3.0-or-later
"""Options of a whole reconstruction."""

from __future__ import annotations

from dataclasses import dataclass

from hdpea.errors import UsageError
from hdpea.options.checked import Checked, option
from hdpea.options.cleaning import CleaningOptions
from hdpea.options.denoising import DenoisingOptions
from hdpea.options.embedding import EmbeddingOptions
from hdpea.options.meshing import POINTS_PER_VERTEX, MeshingOptions
from hdpea.options.normals import NormalOptions
from hdpea.options.particles import (
    ENOUGH_PARTICLES,
    ENOUGH_PER_VERTEX,
    POINTS_PER_PARTICLE,
    POINTS_PER_ROUGH_PARTICLE,
    WORTH_SIMPLIFYING,
    ParticleOptions,
)
from hdpea.options.points_shown import PointsShown
from hdpea.options.refinement import RefinementOptions

TEXTURE_SIZES = {"minimum": 64, "maximum": 16384}
"""Pixels each way; what is larger, graphics cards do not take."""


@dataclass(frozen=True)
class Options(Checked):
    """All options of ``hdpea.reconstruct``."""

    cleaning: CleaningOptions = CleaningOptions()
    normals: NormalOptions = NormalOptions()
    denoising: DenoisingOptions = DenoisingOptions()
    embedding: EmbeddingOptions = EmbeddingOptions()
    particles: ParticleOptions = ParticleOptions()
    meshing: MeshingOptions = MeshingOptions()
    refinement: RefinementOptions = RefinementOptions()
    texture: int | None = option(
        None,
        "OBJ, GLB: colour the mesh by an image of so many pixels each way, for detail finer than the triangles",
        **TEXTURE_SIZES,
    )
    threads: int = option(0, "threads to use; 0: all cores (the result is the same for any number)", minimum=0)

    def __post_init__(self) -> None:
        super().__post_init__()
        given = self.particles.particles
        if given is not None and given < (vertices := self.vertices_of(given)):
            raise UsageError(
                f"{given} particles cannot make {vertices} vertices.", "Spread at least one particle for each vertex."
            )

    def vertices_of(self, points: int) -> int:
        """Return how many vertices to make of so many points."""
        given = self.particles.particles
        if given is not None and self.meshing.any_size:
            return given
        return self.meshing.vertices_of(points)

    def resolution_of(self, points: int) -> int:
        """Return how many vertices would show what so many points do, at least those wanted.

        What is measured in spacings of vertices, such as the bending of the embedding and the holes to fill, goes by
        these, however few are kept in the end.
        """
        return self._enough(points // POINTS_PER_VERTEX, points)

    def particles_of(self, points: int, shown: PointsShown | None = None) -> int:
        """Return how many particles to spread on so many points: at least one for each vertex.

        A mesh is not made of as few particles as it is to have vertices, which cannot show parts thinner than they are
        apart: it is simplified from a mesh of more. Points that are not exact, since they are noisy or their normals
        had to be estimated from many of them, show no more than as many vertices do. Where more vertices than that are
        wanted, more particles are better all the same: of 4,000 points of each of ten training meshes without normals,
        1,000 vertices have a median exact CD of 0.31 instead of 0.42, and 666 one of 0.57 instead of 1.75. And so they
        are where the points were denoised: of depth frames of 25 held-out meshes 23 come nearer to the truth.

        Parameters
        ----------
        shown
            What they can show; default: as much as so many that are exact.
        """
        shown = shown or PointsShown(points)
        if shown.exact or shown.count // POINTS_PER_VERTEX < self.meshing.vertices_of(shown.count):
            enough = shown.count // POINTS_PER_PARTICLE
        elif shown.denoised and self.meshing.error is None and not self.meshing.watertight:
            # Points on scan lines show more along these than across them, where noise leaves nothing between two.
            enough = min(points, shown.count) // POINTS_PER_ROUGH_PARTICLE
        else:
            enough = shown.count // POINTS_PER_VERTEX
        return min(self._enough(enough, shown.count), points)

    def _enough(self, enough: int, shown: int) -> int:
        """Return so many, within limits, if that is clearly more than the vertices wanted of so many points."""
        if self.particles.particles is not None:
            return self.particles.particles
        vertices = self.meshing.vertices_of(shown)
        enough = min(enough, max(ENOUGH_PARTICLES, ENOUGH_PER_VERTEX * vertices))
        return enough if enough >= WORTH_SIMPLIFYING * vertices else vertices
