# SPDX-License-Identifier: GPL-3.0-or-later
from __future__ import annotations

import numpy as np
from helpers import clouds

from hdpea.curvature.interpolation import interpolated_estimate
from hdpea.curvature.tensors import Estimate
from hdpea.geometry.metric import Metric

METRIC = Metric(scale=0.5, max_stretch=8)


def estimate_of(normals: clouds.Array, curvatures: clouds.Array, direction1: clouds.Array) -> Estimate:
    determined = np.ones(len(normals), dtype=bool)
    return Estimate(normals, direction1, METRIC.stretches(curvatures), curvatures, determined)


def test_curvature_that_is_affine_on_a_plane_stays_so() -> None:
    random = np.random.default_rng(0)
    plane = np.column_stack([random.random((2_000, 2)), np.zeros(2_000)])
    others = np.column_stack([0.1 + 0.8 * random.random((500, 2)), np.zeros(500)])

    def curvatures_at(points: clouds.Array) -> clouds.Array:
        return np.stack([20 + 10 * points[:, 0], -5 - points[:, 1]], axis=1)

    ups, xs = np.tile(np.eye(3)[2], (2_000, 1)), np.tile(np.eye(3)[0], (2_000, 1))
    interpolated = interpolated_estimate(plane, estimate_of(ups, curvatures_at(plane), xs), METRIC, True, others)
    np.testing.assert_allclose(interpolated.curvatures, curvatures_at(others), rtol=1e-2)
    np.testing.assert_allclose(abs(interpolated.direction1 @ np.eye(3)[0]), 1)
    np.testing.assert_allclose(interpolated.normals, ups[:500])
    assert interpolated.determined.all()


def test_the_sides_of_a_thin_wall_do_not_mix() -> None:
    random = np.random.default_rng(0)
    sheets = [np.column_stack([random.random((2_000, 2)), np.full(2_000, z)]) for z in (0, 0.01)]
    normals = np.repeat([[0.0, 0, -1], [0, 0, 1]], 2_000, axis=0)
    curvatures = np.repeat([[10.0, 0], [-10, 0]], 2_000, axis=0)
    estimate = estimate_of(normals, curvatures, np.tile(np.eye(3)[0], (4_000, 1)))
    others = np.column_stack([random.random((500, 2)), np.zeros(500)])
    interpolated = interpolated_estimate(np.vstack(sheets), estimate, METRIC, True, others)
    np.testing.assert_allclose(interpolated.curvatures, np.tile([10.0, 0], (500, 1)), atol=1e-9)
    np.testing.assert_allclose(interpolated.normals, normals[:500])


def test_unknown_tensors_do_not_count() -> None:
    points, normals = clouds.sphere(2_000)
    curvatures = np.ones((2_000, 2))
    curvatures[::7] = np.nan
    direction1 = np.cross(normals, np.eye(3)[0] + 1e-3)
    direction1 /= np.linalg.norm(direction1, axis=1, keepdims=True)
    interpolated = interpolated_estimate(points, estimate_of(normals, curvatures, direction1), METRIC, True, points)
    # Tensors of planes that tilt by a tenth of a radian, put into one, lose about the square of it.
    np.testing.assert_allclose(interpolated.curvatures, 1, rtol=0.03)
    curvatures[:] = np.nan
    interpolated = interpolated_estimate(points, estimate_of(normals, curvatures, direction1), METRIC, True, points)
    assert np.isnan(interpolated.curvatures).all()
    assert not interpolated.determined.any()
    np.testing.assert_allclose(interpolated.normals, normals)


def test_without_a_metric_stretches_are_interpolated_and_curvatures_unknown() -> None:
    points, normals = clouds.sphere(2_000)
    direction1 = np.cross(normals, np.eye(3)[0] + 1e-3)
    direction1 /= np.linalg.norm(direction1, axis=1, keepdims=True)
    estimate = Estimate(
        normals, direction1, np.tile([3.0, 3.0], (2_000, 1)), np.full((2_000, 2), np.nan), normals[:, 0] > 2
    )
    interpolated = interpolated_estimate(points, estimate, None, False, points)
    np.testing.assert_allclose(interpolated.stretches, 3, rtol=0.02)
    assert np.isnan(interpolated.curvatures).all()
    assert not interpolated.determined.any()


def test_magnitudes_stay_in_the_range_and_outliers_take_a_mean() -> None:
    random = np.random.default_rng(0)
    plane = np.column_stack([random.random((2_000, 2)), np.zeros(2_000)])
    ups, xs = np.tile(np.eye(3)[2], (2_000, 1)), np.tile(np.eye(3)[0], (2_000, 1))
    steep = np.stack([100 * plane[:, 0] ** 2, 3 * plane[:, 1]], axis=1).clip(*METRIC.curvature_range)
    others = np.vstack([random.random((500, 3)) * [1.1, 1.1, 0], [[30.0, 0.5, 0], [0.5, -40, 2]]])
    interpolated = interpolated_estimate(plane, estimate_of(ups, steep, xs), METRIC, False, others)
    low, high = METRIC.curvature_range
    assert (interpolated.curvatures >= low).all()
    assert (interpolated.curvatures <= high).all()
    np.testing.assert_allclose(interpolated.normals, np.tile([0.0, 0, 1], (502, 1)))
    signed = interpolated_estimate(plane, estimate_of(ups, steep, xs), METRIC, True, others)
    assert (signed.curvatures[500:] >= low).all()
    assert (signed.curvatures[500:] <= 100).all()
