# SPDX-License-Identifier: GPL-3.0-or-later
"""What is simplified is made even again, without leaving the points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import trimesh
from helpers import clouds
from helpers.reconstructions import assert_same_bytes, cloud_of, mesh_of, options
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from hdpea import Reconstruction, _core, reconstruct
from hdpea.errors import Interrupted
from hdpea.mesh import fitting
from hdpea.mesh.extraction import Mesh
from hdpea.surface.surface import Surface


def evenness(mesh: Reconstruction) -> float:
    """Return the share of vertices at which six faces meet."""
    counts: NDArray[np.int64] = np.bincount(mesh.faces.ravel())
    return float((counts == 6).mean())


def test_collapses_alone_leave_fewer_regular_vertices(monkeypatch: pytest.MonkeyPatch) -> None:
    remeshed = evenness(mesh_of("sphere"))
    monkeypatch.setattr(fitting, "remesh_anisotropically", lambda mesh, *_: mesh)
    assert remeshed > evenness(reconstruct(*cloud_of("sphere"), options())) + 0.1


@pytest.mark.parametrize("shape", ["sphere", "torus", "cube"])
def test_it_keeps_the_topology_and_cuts_nothing(shape: str) -> None:
    made = mesh_of(shape).report.mesh
    assert made is not None
    assert made.closed
    assert made.manifold
    assert made.genus == (1 if shape == "torus" else 0)
    assert made.self_intersections == 0


def test_it_is_the_same_for_any_number_of_threads() -> None:
    points, normals = clouds.torus(2000)
    assert_same_bytes(*(reconstruct(points, normals, options(200, threads=threads)) for threads in (1, 2)))


def test_points_whose_normals_are_estimated_get_no_more_particles_than_vertices() -> None:
    points, normals = clouds.torus(2000)
    for given, simplified in ((normals, True), (None, False)):
        assert ("edges_collapsed" in reconstruct(points, given, vertices=240).report.meshing) == simplified


def test_it_can_be_interrupted() -> None:
    with pytest.raises(Interrupted):
        reconstruct(*cloud_of("sphere", 500), options(60), lambda phase, _: phase != "remeshing")


def test_a_wall_thinner_than_the_vertices_are_apart_keeps_its_thickness() -> None:
    size = (1, 0.6, 0.02)
    fine = trimesh.Trimesh(*trimesh.remesh.subdivide_to_size(*_box(size), 0.04))
    fine.merge_vertices()
    vertices, faces = np.array(fine.vertices), np.array(fine.faces, dtype=np.int64)
    points, normals = np.array(fine.triangles_center), np.array(fine.face_normals)
    budget = _core.MeshBudget()
    budget.vertices = 100
    few = _core.simplify_mesh(vertices, vertices, faces, points, normals, budget, None)
    first = np.cross(normals, [0.3, 0.5, 0.8])
    first /= np.linalg.norm(first, axis=1)[:, None]
    bases = np.hstack([first, np.cross(normals, first)])
    made = _core.remesh_anisotropically(few.vertices, few.coordinates, few.faces, points, bases, normals, None)
    assert trimesh.Trimesh(made.vertices, made.faces).volume > 0.95 * np.prod(size)


def test_no_vertex_is_moved_where_there_are_no_points(monkeypatch: pytest.MonkeyPatch) -> None:
    # Beyond a rim, the planes of the lid and of the side go on into the air.
    count = 4000
    points, normals = clouds.can(count)
    spacing = np.sqrt(1.5 * np.pi / count) / np.linalg.norm(np.ptp(points, axis=0))
    remesh, moved_away = fitting.remesh_anisotropically, list[float]()

    def watched(mesh: Mesh, surface: Surface, *others: Any) -> Mesh:
        made = remesh(mesh, surface, *others)
        tree = cKDTree(surface.points_in_unit)
        before, after = (tree.query(each.vertices_in_unit)[0] for each in (mesh, made))
        moved_away.append(after[after > before].max())
        return made

    monkeypatch.setattr(fitting, "remesh_anisotropically", watched)
    reconstruct(points, normals, vertices=count // 8)
    assert max(moved_away) < 1.25 * spacing


def _box(size: tuple[float, float, float]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    box = trimesh.creation.box(size)
    return np.array(box.vertices), np.array(box.faces)
