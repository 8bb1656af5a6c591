# SPDX-License-Identifier: GPL-3.0-or-later
"""The stages of `hdpea.reconstruct`, called one by one on a torus.

    python examples/stages_by_hand.py torus.obj

Each stage takes and returns arrays, or one small dataclass of them: inspect or replace any of them.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from shapes import sample

from hdpea.embedding import embed_surface
from hdpea.embedding.tangents import tangent_bases
from hdpea.mesh.extraction import extract_mesh
from hdpea.mesh.particles import spread_particles
from hdpea.mesh.refinement import refine_mesh
from hdpea.options import EmbeddingOptions
from hdpea.surface.normals import oriented_surface
from hdpea.writing.meshes import write_mesh


def main(out: Path, vertices: int = 1_000) -> None:
    """Reconstruct a torus and print what each stage did."""
    points, normals = sample("torus", 20_000)

    # Unit frame, one orientation, neighbours along the surface: the input of all later stages.
    surface = oriented_surface(points, normals).surface
    print(f"points are {surface.spacing:.4f} of the diagonal apart")

    # Coordinates in R^8, where the curvature metric is Euclidean: the first three are the points'.
    coordinates = embed_surface(surface, vertices, EmbeddingOptions()).coordinates
    bases = tangent_bases(coordinates, surface.normals, surface.neighbors)
    stretch = np.ptp(coordinates, axis=0)
    print(f"extent in R^3: {stretch[:3].round(2)}, in the five dimensions added: {stretch[3:].round(2)}")

    # Evenly spaced in R^8, and so dense around the tube and sparse along it in R^3.
    particles = spread_particles(coordinates, bases, surface.neighbors, vertices)
    mesh = extract_mesh(particles, bases, surface)
    print(f"{mesh.statistics['t3']} triangles agreed upon by all three corners; {len(mesh.faces)} faces")

    # Vertices lie on tangent planes, outside of convex bends; the fit moves the faces onto the points.
    fitted = refine_mesh(mesh, surface)
    moved = np.linalg.norm(fitted.vertices_in_unit - mesh.vertices_in_unit, axis=1)
    print(f"the fit moved vertices by {moved.mean():.5f} of the diagonal on average")

    write_mesh(out, surface.frame.to_world(fitted.vertices_in_unit), fitted.faces)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
