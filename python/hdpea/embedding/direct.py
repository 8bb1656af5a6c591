# SPDX-License-Identifier: GPL-3.0-or-later
"""The direct embedding: curvature and triangles from the points themselves, then the core's solver."""

from __future__ import annotations

import numpy as np

from hdpea import _core
from hdpea.embedding.embedded import Embedded
from hdpea.geometry.metric import ScaledMetric
from hdpea.options import EmbeddingOptions
from hdpea.options.choice import Choice
from hdpea.options.embedding import BENDING_LENGTH, CURVATURE_RADIUS
from hdpea.options.lengths import Length
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.surface import Surface
from hdpea.surface.triangle_soup import triangle_soup

LONGEST_BENDING = 1e3
"""In diagonals of the cloud: beyond it psi does not bend at all, and its system is too stiff for double precision."""


def embed_directly(surface: Surface, vertices: int, options: EmbeddingOptions, progress: PhaseCallback) -> Embedded:
    """Return the embedding [p, psi] of a surface, at the scale of a mesh with that many `vertices`.

    Curvature is fitted to the normals; psi is solved for on a soup of restricted Delaunay triangles in place of a mesh
    (``solve_embedding`` of the core).
    """
    points, normals = surface.points_in_unit, surface.normals
    soup = triangle_soup(points, normals, surface.neighbors)
    spacing = float(np.sqrt(soup.area / vertices))
    choices: list[Choice] = []

    def choose(name: str, given: Length | None, per_spacing: float) -> float:
        if given is not None:
            return surface.frame.length_to_unit(given)
        chosen = per_spacing * spacing
        choices.append(length_choice(name, chosen * surface.frame.diagonal, per_spacing, vertices))
        return chosen

    bending_length = min(choose("bending_length", options.bending_length, BENDING_LENGTH), LONGEST_BENDING)
    curvature_radius = choose("curvature_radius", options.curvature_radius, CURVATURE_RADIUS)
    metric = ScaledMetric(options.metric_scale, options.max_stretch, bending_length, curvature_radius)
    curvature = _core.estimate_curvature(points, normals, surface.neighbors, metric.curvature_radius)
    psi = _core.solve_embedding(points, normals, curvature, soup.triangles, soup.weights, metric.solver(), progress)
    return Embedded(np.hstack([points, psi]), tuple(choices), metric)


def length_choice(name: str, in_world: float, per_spacing: float, vertices: int) -> Choice:
    """Return what the report tells of a length that was chosen as so many spacings of so many vertices."""
    why = f"{per_spacing:g} times the spacing of {vertices:,} vertices on the surface"
    return Choice(name, in_world, "world units", why)
