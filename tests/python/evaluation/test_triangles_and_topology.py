# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape of triangles and what a mesh is, against closed forms or another library."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from helpers.analytic_meshes import CYLINDER
from helpers.true_shapes import FEW, Mesh, box, measured, mesh_of, sphere, square

from hdpea.evaluation.curvature_metric import MOST_STRETCHED, triangle_qualities
from hdpea.evaluation.evaluation import evaluate
from hdpea.evaluation.triangle_shapes import triangle_angles
from hdpea.evaluation.truth import truth_of_mesh


def test_qualities_are_closed_forms() -> None:
    equilateral = [[0, 0, 0], [1, 0, 0], [0.5, 0.75**0.5, 0]]
    right_angled = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    no_area = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]
    qualities = triangle_qualities(np.array([equilateral, right_angled, no_area, np.zeros((3, 3))]))
    of_right_angled = 2 * 3**0.5 * 0.5 / ((2 + 2**0.5) / 2 * 2**0.5)
    np.testing.assert_allclose(qualities, [1, of_right_angled, 0, 0], atol=1e-15)


def test_on_a_sphere_the_metric_is_the_same_in_all_directions() -> None:
    triangles = measured(sphere(2), "sphere").triangles
    assert triangles.g == pytest.approx(triangles.g_isotropic, abs=0.005)


def cylinder_of_triangles(stretch: float) -> Mesh:
    """Cover the side of ``CYLINDER`` by triangles so many times as high as wide, equilateral but for that."""
    around = 48
    rows = round(2 / (stretch * 0.75**0.5 * np.pi / around))
    row, column = (each.ravel() for each in np.meshgrid(np.arange(rows + 1), np.arange(around), indexing="ij"))
    angle = 2 * np.pi / around * (column + row % 2 / 2)
    height = stretch * 0.75**0.5 * np.pi / around * row
    vertices = np.stack([0.5 * np.cos(angle), 0.5 * np.sin(angle), height], axis=1)
    faces = []
    for i in range(rows):
        for j in range(around):
            here, right = i * around + j, i * around + (j + 1) % around
            above, above_right = here + around, right + around
            shifted = i % 2
            faces += [[here, right, above_right if shifted else above]]
            faces += [[above, here if shifted else right, above_right]]
    return vertices, np.array(faces)


def test_on_a_cylinder_triangles_are_best_as_long_as_the_curvature_says() -> None:
    # Curvature 1 / 0.5 around, in a box 2 high; along the axis it counts as flat.
    best = min(((2 / 0.5) / 1.0) ** 0.5, MOST_STRETCHED)
    side = replace(CYLINDER, capped=False).mesh("regular")
    truth = truth_of_mesh(*side, FEW)
    qualities = {}
    for stretch in (1.0, best, 5.0):
        triangles = evaluate(*cylinder_of_triangles(stretch), truth).triangles
        assert triangles.g is not None
        qualities[stretch] = triangles.g
        # Mapped by the metric, they are equilateral but for a factor.
        factor = stretch / best
        mapped = np.array([[[0, 0, 0], [1, 0, 0], [0.5, factor * 0.75**0.5, 0]]])
        assert triangles.g == pytest.approx(triangle_qualities(mapped)[0], abs=0.02)
    assert max(qualities, key=lambda each: qualities[each]) == best


def test_angles_are_those_of_another_library() -> None:
    vertices, faces = np.random.default_rng(0).random((300, 3)), np.arange(300).reshape(100, 3)
    expected = np.degrees(trimesh.Trimesh(vertices, faces, process=False).face_angles)
    np.testing.assert_allclose(triangle_angles(vertices, faces), expected)


def test_thin_triangles_are_counted() -> None:
    sliver = np.tan(np.radians(0.9))
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0.5, 0.75**0.5, 0], [1, sliver, 0], [2, 0, 0]])
    triangles = measured((vertices, np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]]))).triangles
    assert triangles.degenerate == pytest.approx(2 / 3)
    assert triangles.smallest_angle == 0
    assert triangles.largest_angle == 180
    assert triangles.mean_smallest_angle == pytest.approx((60 + 0.9 + 0) / 3)


@pytest.mark.parametrize(
    "mesh", [trimesh.creation.torus(1.0, 0.4, 24, 12), trimesh.creation.icosphere(2)], ids=["torus", "sphere"]
)
def test_topology_is_that_of_another_library(mesh: trimesh.Trimesh) -> None:
    topology = measured(mesh_of(mesh)).topology
    assert topology.watertight
    assert topology.manifold
    assert topology.oriented
    assert topology.genus == (2 - mesh.euler_number) // 2
    vertices, faces = mesh_of(mesh)
    holed = measured((vertices, faces[1:])).topology
    assert (holed.watertight, holed.boundary_edges, holed.boundary_loops, holed.genus) == (False, 3, 1, None)


def test_defects_are_counted() -> None:
    vertices, faces = box(1)
    fin = np.vstack([vertices, [5, 0, 0]]), np.vstack([faces, [faces[0, 0], faces[0, 1], 8]])
    topology = measured(fin).topology
    assert not topology.manifold
    assert not topology.watertight
    assert (topology.nonmanifold_edges, topology.boundary_edges) == (1, 2)
    turned = np.vstack([faces[:1, ::-1], faces[1:]])
    assert not measured((vertices, turned)).topology.oriented
    crossing = [*square(), *mesh_of(trimesh.creation.icosphere(1, 0.2))]
    both = np.vstack([crossing[0], crossing[2]]), np.vstack([crossing[1], crossing[3] + 4])
    assert measured(both).topology.self_intersections > 0
