# SPDX-License-Identifier: GPL-3.0-or-later
"""Mending faces that cut others, which the fit to noisy points leaves here and there."""

from __future__ import annotations

from dataclasses import replace

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.mesh.extraction import Mesh


def repair_mesh(mesh: Mesh) -> Mesh:
    """Return the mesh without its self-intersections, but for those where two walls pass through each other."""
    with core_errors_translated():
        repaired = _core.repair_self_intersections(mesh.vertices_in_unit, mesh.faces)
        same = _core.nearest_neighbors(mesh.vertices_in_unit, repaired.vertices, 1)[:, 0]
    return replace(
        mesh,
        vertices_in_unit=repaired.vertices,
        faces=repaired.faces,
        coordinates=mesh.coordinates[same],
        self_intersections=repaired.self_intersections,
    )
