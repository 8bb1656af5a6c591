# SPDX-License-Identifier: GPL-3.0-or-later
"""Sampling: on the faces it says, by area, seeded."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import meshes

from hdpea import _core
from hdpea.errors import CannotReconstruct, UsageError
from hdpea.geometry.sampling import SurfaceSamples, face_normals, sample_surface

METHODS = ("area", "farthest")


def sampled(mesh: meshes.Mesh, points: int = 2000, method: str = "area", seed: int = 0) -> SurfaceSamples:
    return sample_surface(*mesh, points, method=method, seed=seed)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("points", [1, 7, 1000])
def test_points_lie_on_their_faces_with_the_normals_of_these(method: str, points: int) -> None:
    vertices, faces = mesh = meshes.torus()
    drawn = sampled(mesh, points, method)
    assert len(drawn.points) == points
    np.testing.assert_allclose(drawn.barycentric.sum(axis=1), 1)
    assert drawn.barycentric.min() >= 0
    by_weights = (drawn.barycentric[:, :, None] * vertices[faces[drawn.faces]]).sum(axis=1)
    np.testing.assert_allclose(drawn.points, by_weights, atol=1e-12)
    np.testing.assert_array_equal(drawn.normals, face_normals(vertices, faces)[0][drawn.faces])


def test_points_are_spread_by_area() -> None:
    normals = abs(sampled(meshes.box(), 20_000).normals)
    np.testing.assert_allclose(normals.mean(axis=0), np.array([2, 3, 6]) / 11, atol=0.015)


def test_farthest_points_are_spread_more_evenly() -> None:
    def variation(method: str) -> float:
        points = sampled(meshes.icosphere(), method=method).points
        spacings = np.linalg.norm(points[_core.nearest_neighbors(points, 1)[:, 0]] - points, axis=1)
        return float(spacings.std() / spacings.mean())

    assert variation("farthest") < 0.2
    assert variation("area") > 0.4


@pytest.mark.parametrize("method", METHODS)
def test_seed_decides(method: str) -> None:
    one, same, other = (sampled(meshes.torus(), method=method, seed=seed).points for seed in (1, 1, 2))
    np.testing.assert_array_equal(one, same)
    assert (one != other).any()


@pytest.mark.parametrize("method", METHODS)
def test_double_and_degenerate_faces_change_nothing(method: str) -> None:
    vertices, faces = mesh = meshes.box()
    worse = np.vstack([faces, faces[2:3], faces[3:4, ::-1], [[0, 0, 1], [2, 2, 2]]])
    np.testing.assert_array_equal(sampled((vertices, worse), method=method).points, sampled(mesh, method=method).points)


def test_a_mesh_without_area_is_refused() -> None:
    with pytest.raises(CannotReconstruct, match="no area"):
        sampled((np.eye(3), np.array([[0, 1, 1]])))


@pytest.mark.parametrize(("points", "method"), [(0, "area"), (10, "poisson")])
def test_what_cannot_be_drawn_is_refused(points: int, method: str) -> None:
    with pytest.raises(UsageError, match="Cannot draw"):
        sampled(meshes.box(), points, method)
