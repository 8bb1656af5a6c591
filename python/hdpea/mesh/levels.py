# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarser versions of a mesh, each made from the one before."""

from __future__ import annotations

from collections.abc import Iterator

from hdpea.mesh.error_bound import ErrorBound, mended_within, simplify_within
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.refinement import refine_mesh
from hdpea.mesh.repair import repair_mesh
from hdpea.mesh.simplification import simplify_mesh
from hdpea.options import MeshingOptions, Options
from hdpea.surface.surface import Surface

FEWER = 2
"""How many times fewer faces a level has than the one before, or how many times its error may be larger."""

FEWEST_FACES = 8
"""A level is not asked to have fewer."""


def coarser_levels(mesh: Mesh, surface: Surface, options: Options) -> Iterator[Mesh]:
    """Yield the levels after the mesh itself, as many as the options ask for: ``MeshingOptions.lod`` less one.

    With an error, each level may be twice as far from the points as the one before, up to its error; else it has half
    as many faces. Vertices are fitted to the points, not to the level before, so errors do not add up.
    """
    for number in range(1, options.meshing.lod):
        if options.meshing.error is not None:
            error = surface.frame.length_to_unit(options.meshing.error) * FEWER**number
            bound = ErrorBound(surface, error)
            mesh = mended_within(simplify_within(mesh, bound), bound)
        else:
            half = MeshingOptions(faces=max(len(mesh.faces) // FEWER, FEWEST_FACES))
            mesh = simplify_mesh(mesh, surface, half)
            mesh = repair_mesh(refine_mesh(mesh, surface, options.refinement), surface.points_in_unit)
        yield mesh
