# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices that are fixed stay, whatever is done with the mesh around them."""

from __future__ import annotations

import numpy as np
from helpers import clouds
from helpers.reconstructions import mesh_of

from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.creases import align_to_creases, find_creases
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.refinement import refine_mesh
from hdpea.mesh.simplification import simplify_mesh
from hdpea.options import MeshingOptions
from hdpea.surface.surface import Surface


def test_fixed_vertices_stay_in_a_fit_a_simplification_and_beside_creases() -> None:
    points, normals = clouds.box(4_000)
    surface = Surface.of(UnitFrame(np.zeros(3), 1.0), points, normals)
    made = mesh_of("cube", refine=False)
    # Off the surface, so that a fit and creases would move all of them.
    vertices = made.vertices * 1.01
    mesh, fixed = Mesh(vertices, made.faces, vertices), np.arange(len(vertices)) < len(vertices) // 2
    fitted = refine_mesh(mesh, surface, fixed=fixed)
    aligned = align_to_creases(mesh, find_creases(surface), fixed)
    for moved in (fitted, aligned):
        same = (moved.vertices_in_unit == vertices).all(axis=1)
        assert same[fixed].all()
        assert not same[~fixed].all()
    small = simplify_mesh(mesh, surface, MeshingOptions(vertices=int(0.7 * len(vertices))), fixed=fixed)
    assert len(small.vertices_in_unit) == int(0.7 * len(vertices))
    np.testing.assert_array_equal(small.vertices_in_unit[: fixed.sum()], vertices[fixed])
