# SPDX-License-Identifier: GPL-3.0-or-later
"""Moving least squares: less noise, the same shape."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from helpers import clouds

from hdpea.errors import Interrupted, UsageError
from hdpea.frontend.roughness import roughness_of
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import DenoisingOptions, MeshingOptions, Options
from hdpea.reconstruction import reconstruct
from hdpea.surface.denoising import denoised
from hdpea.surface.normals import OrientedSurface
from hdpea.surface.surface import Surface

MLS = DenoisingOptions(denoise="mls")
POINTS = 3000


def oriented(cloud: clouds.Cloud, estimated: bool = False) -> OrientedSurface:
    frame = UnitFrame.around(cloud[0])
    surface = Surface.of(frame, frame.to_unit(cloud[0]), cloud[1])
    roughness = roughness_of(surface.points_in_unit)
    return OrientedSurface(surface, roughness, len(cloud[0]) if estimated else 0, None, "file")


def after(cloud: clouds.Cloud) -> clouds.Cloud:
    """Return the points in the world, and the normals, after denoising."""
    made, _ = denoised(oriented(cloud), MLS)
    return made.frame.to_world(made.points_in_unit), made.normals


def noisy(cloud: clouds.Cloud, std: float) -> clouds.Cloud:
    """Return the points with noise, and the normals with as much of it as spacings and noise give them."""
    random = np.random.default_rng(7)
    tilted = cloud[1] + 5 * std * random.normal(size=cloud[1].shape)
    tilted /= np.linalg.norm(tilted, axis=1, keepdims=True)
    return cloud[0] + std * random.normal(size=cloud[0].shape), tilted


def rms(values: clouds.Array) -> float:
    return float(np.sqrt((values**2).mean()))


@pytest.mark.parametrize("cloud", [clouds.sphere, clouds.torus, clouds.box])
def test_clean_points_stay_as_they_are(cloud: Callable[[int], clouds.Cloud]) -> None:
    given = oriented(cloud(POINTS), estimated=True)
    made, (choice,) = denoised(given, DenoisingOptions())
    assert made is given.surface
    assert (choice.name, choice.value) == ("denoise", "none")


def test_more_neighbours_than_points_are_all_points() -> None:
    given = oriented(noisy(clouds.sphere(100), 0.03))
    every, more = (denoised(given, DenoisingOptions("mls", count))[0].points_in_unit for count in (100, 2**31 - 1))
    np.testing.assert_array_equal(every, more)


def test_noisy_points_are_denoised_unless_they_are_not_to_be() -> None:
    given = oriented(noisy(clouds.sphere(POINTS), 0.03))
    made, (choice, count) = denoised(given, DenoisingOptions())
    np.testing.assert_array_equal(made.points_in_unit, denoised(given, MLS)[0].points_in_unit)
    assert choice.value == "mls"
    assert "0.4 spacings" in choice.why  # of noise of half a spacing
    assert (count.name, count.value) == ("denoise_neighbors", 80)
    assert denoised(given, DenoisingOptions(denoise="none")) == (given.surface, ())


@pytest.mark.parametrize(("std", "count"), [(0.005, 80), (0.06, 200), (0.1, 320)])
def test_the_noisier_the_points_the_more_neighbors_are_fitted(std: float, count: int) -> None:
    given = oriented(noisy(clouds.sphere(POINTS), std))
    made, (choice,) = denoised(given, MLS)
    assert choice.value == count
    by_hand, choices = denoised(given, DenoisingOptions(denoise="mls", denoise_neighbors=count))
    np.testing.assert_array_equal(made.points_in_unit, by_hand.points_in_unit)
    assert choices == ()


def test_noise_of_more_than_a_spacing_is_taken_away() -> None:
    given = noisy(clouds.sphere(POINTS), 0.08)  # of points 0.065 apart
    points, _ = after(given)
    assert rms(np.linalg.norm(points, axis=1) - 1) < 0.25 * rms(np.linalg.norm(given[0], axis=1) - 1)


@pytest.mark.parametrize(("estimated", "way"), [(False, "none"), (True, "mls")])
def test_the_sides_of_a_thin_wall_are_parted_unless_normals_do_it(estimated: bool, way: str) -> None:
    wall = clouds.two_sheets(POINTS, spacings_apart=1, facing=-1)
    _, (choice, *_) = denoised(oriented(wall, estimated), DenoisingOptions())
    assert choice.value == way
    assert "rather than its noise" in choice.why


def test_a_plane_stays_where_it_is() -> None:
    plane = clouds.plane(POINTS, height=3)
    points, normals = after(plane)
    np.testing.assert_allclose(points, plane[0], atol=1e-9)
    np.testing.assert_allclose(normals, plane[1], atol=1e-9)


@pytest.mark.parametrize("shape", [clouds.sphere, clouds.cylinder, clouds.torus])
def test_clean_points_hardly_move(shape: Callable[[int], clouds.Cloud]) -> None:
    cloud = shape(POINTS)
    points, _ = after(cloud)
    assert np.linalg.norm(points - cloud[0], axis=1).max() < 0.02  # of a radius of 0.4 and more


def test_a_noisy_sphere_gets_nearer_its_sphere_and_does_not_shrink() -> None:
    sphere = clouds.sphere(POINTS)
    given = noisy(sphere, 0.02)
    points, normals = after(given)
    assert rms(np.linalg.norm(points, axis=1) - 1) < 0.4 * rms(np.linalg.norm(given[0], axis=1) - 1)
    assert np.linalg.norm(points, axis=1).mean() == pytest.approx(1, abs=0.005)
    assert np.einsum("nc,nc->n", normals, sphere[1]).mean() > np.einsum("nc,nc->n", given[1], sphere[1]).mean()
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)


def test_the_edges_of_a_box_stay_sharp() -> None:
    box = clouds.box(POINTS)
    points, normals = after(box)
    moved = np.linalg.norm(points - box[0], axis=1)
    assert moved.max() < 0.005  # a quarter of the spacing
    assert np.einsum("nc,nc->n", normals, box[1]).min() > 0.98


def test_the_two_sides_of_a_thin_wall_do_not_collapse() -> None:
    sheets = clouds.two_sheets(POINTS, spacings_apart=3, facing=-1)
    points, _ = after(sheets)
    assert np.linalg.norm(points - sheets[0], axis=1).max() < 1e-6  # of a wall of 0.08


def test_the_order_of_the_points_does_not_matter() -> None:
    cloud = noisy(clouds.torus(POINTS), 0.01)
    order = np.random.default_rng(1).permutation(POINTS)
    points, normals = after(cloud)
    shuffled, turned = after((cloud[0][order], cloud[1][order]))
    np.testing.assert_allclose(shuffled, points[order], atol=1e-9)
    np.testing.assert_allclose(turned, normals[order], atol=1e-7)


def test_scale_and_place_do_not_matter() -> None:
    cloud = noisy(clouds.torus(POINTS), 0.01)
    points, normals = after(cloud)
    larger, turned = after((1000 * cloud[0] + 1e5, cloud[1]))
    np.testing.assert_allclose((larger - 1e5) / 1000, points, atol=1e-6)
    np.testing.assert_allclose(turned, normals, atol=1e-4)


def test_a_mesh_of_noisy_points_gets_better() -> None:
    given = noisy(clouds.sphere(POINTS), 0.02)
    meshing = MeshingOptions(vertices=800)
    errors = [
        rms(np.linalg.norm(reconstruct(*given, Options(denoising=each, meshing=meshing)).vertices, axis=1) - 1)
        for each in (DenoisingOptions(denoise="none"), MLS)
    ]
    assert errors[1] < 0.6 * errors[0]


def test_it_can_be_cancelled() -> None:
    with pytest.raises(Interrupted):
        denoised(oriented(clouds.sphere(100)), MLS, lambda _phase, _fraction: False)


def test_too_few_neighbors_are_refused() -> None:
    with pytest.raises(UsageError, match="`denoise_neighbors` is at least 6"):
        DenoisingOptions(denoise_neighbors=5)
