# SPDX-License-Identifier: GPL-3.0-or-later
"""Tensors from principal values and directions, and back."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea.geometry.tensors import (
    frames,
    metric_tensors,
    principal,
    principal_in_planes,
    symmetric_tensors,
    tangent_directions,
)


@pytest.fixture
def surface() -> tuple[clouds.Array, clouds.Array, clouds.Array]:
    """Normals, principal directions and values of 200 points, |k1| > |k2|."""
    normals = clouds.sphere(200)[1]
    direction1 = np.cross(normals, [0.3, -0.5, 0.8])
    direction1 /= np.linalg.norm(direction1, axis=1, keepdims=True)
    random = np.random.default_rng(0)
    k1 = random.choice([-1, 1], 200) * random.uniform(2, 3, 200)
    return normals, direction1, np.stack([k1, random.uniform(-1, 1, 200)], axis=1)


def test_frames_are_right_handed_and_orthonormal(surface: tuple[clouds.Array, clouds.Array, clouds.Array]) -> None:
    normals, direction1, _ = surface
    axes = frames(normals, direction1)
    np.testing.assert_allclose(axes @ axes.swapaxes(1, 2), np.tile(np.eye(3), (200, 1, 1)), atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(axes), 1)


def test_principal_values_and_directions_come_back(surface: tuple[clouds.Array, clouds.Array, clouds.Array]) -> None:
    normals, direction1, values = surface
    tensors = symmetric_tensors(values, tangent_directions(normals, direction1))
    for found, direction in (principal(tensors), principal_in_planes(tensors, normals)):
        np.testing.assert_allclose(found, values, atol=1e-12)
        np.testing.assert_allclose(abs((direction * direction1).sum(axis=1)), 1)


def test_the_metric_measures_stretches_along_the_directions_and_one_along_the_normal(
    surface: tuple[clouds.Array, clouds.Array, clouds.Array],
) -> None:
    normals, direction1, _ = surface
    metric = metric_tensors(normals, direction1, np.tile([3.0, 2.0], (200, 1)))
    axes = frames(normals, direction1)
    np.testing.assert_allclose(
        axes @ metric @ axes.swapaxes(1, 2), np.tile(np.diag([9.0, 4, 1]), (200, 1, 1)), atol=1e-12
    )
