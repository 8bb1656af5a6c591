# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np
import pytest
from helpers import meshes

from hdpea.geometry.mesh_curvature import largest_curvatures, triangle_stretches, vertex_means


@pytest.mark.parametrize("scale", [1e-150, 1.0, 1e150])
def test_a_sphere_bends_as_its_radius_says(scale: float) -> None:
    vertices, faces = meshes.icosphere()
    radius = scale * np.linalg.norm(vertices[0] - vertices.mean(axis=0))
    np.testing.assert_allclose(radius * largest_curvatures(scale * vertices, faces), 1, rtol=1e-3)


def test_what_is_hollow_is_negative() -> None:
    vertices, faces = meshes.icosphere()
    np.testing.assert_allclose(
        largest_curvatures(vertices, faces[:, ::-1].copy()), -largest_curvatures(vertices, faces), rtol=1e-6
    )


def test_a_plane_is_flat_and_faces_without_area_do_no_harm() -> None:
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [5, 5, 5]])
    faces = np.array([[0, 1, 2], [0, 2, 3], [0, 1, 4]])
    curvatures = largest_curvatures(vertices, faces)
    np.testing.assert_allclose(curvatures[:4], 0, atol=1e-6)
    assert np.isnan(curvatures[5])


def test_stretches_are_those_of_the_map_from_an_equilateral_triangle() -> None:
    equilateral = np.array([[0.0, 0, 0], [1, 0, 0], [0.5, np.sqrt(0.75), 0]])
    vertices = np.vstack([equilateral, equilateral * [3, 1, 1], equilateral * [1, 0, 1]])
    faces = np.arange(9).reshape(3, 3)
    np.testing.assert_allclose(triangle_stretches(vertices, faces), [1, 3, np.inf], rtol=1e-6)


def test_means_at_vertices_are_weighted() -> None:
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    means = vertex_means(np.array([1.0, 4]), faces, np.array([2.0, 1]), 5)
    np.testing.assert_allclose(means, [2, 1, 2, 4, np.nan])
