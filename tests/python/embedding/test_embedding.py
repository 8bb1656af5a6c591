# SPDX-License-Identifier: GPL-3.0-or-later
"""Every embedding keeps the interface and stretches where the surface bends."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest
from helpers import clouds

from hdpea import _core, embed_points, reconstruct
from hdpea.embedding import EMBEDDERS, Embedding, embed_surface
from hdpea.embedding.embedded import Embedded
from hdpea.errors import Interrupted, UsageError
from hdpea.options import EmbeddingOptions, MeshingOptions, Options
from hdpea.options.lengths import Length
from hdpea.surface.normals import oriented_surface
from hdpea.surface.surface import Surface
from hdpea.surface.triangle_soup import triangle_soup

BOTH = [
    pytest.param(EmbeddingOptions(metric_scale=1), id="direct"),
    pytest.param(EmbeddingOptions(embedding="learned"), id="learned"),
]


def surface_of(cloud: clouds.Cloud) -> Surface:
    return oriented_surface(*cloud).surface


def stretches(surface: Surface, coordinates: clouds.Array, direction: clouds.Array) -> clouds.Array:
    """Return how much longer in R^8 than in R^3 the ways to those neighbours are that lie in a direction (n, 3)."""
    neighbors = surface.neighbors[:, :12]
    ways = surface.points_in_unit[neighbors] - surface.points_in_unit[:, None]
    lengths = np.linalg.norm(ways, axis=2)
    along = abs(np.einsum("nkc,nc->nk", ways, direction)) > 0.95 * lengths
    embedded = np.linalg.norm(coordinates[neighbors] - coordinates[:, None], axis=2)
    return (embedded / lengths)[along & (neighbors >= 0)]


def distances_across(coordinates: clouds.Array) -> clouds.Array:
    """Return the distance of each point of the first half to the nearest of the second."""
    first, second = np.split(coordinates, 2)
    nearest = _core.nearest_neighbors(second, first, 1)[:, 0]
    return np.linalg.norm(second[nearest] - first, axis=1)


@pytest.mark.parametrize("name", EMBEDDERS)
@pytest.mark.parametrize("shape", ["torus", "plane"])
def test_an_embedding_extends_the_points_by_five_finite_columns(name: str, shape: str) -> None:
    surface = surface_of(getattr(clouds, shape)(1500))
    embedded = embed_surface(surface, 200, EmbeddingOptions(embedding=name))
    assert embedded.coordinates.shape == (1500, 8)
    assert np.isfinite(embedded.coordinates).all()
    np.testing.assert_array_equal(embedded.coordinates[:, :3], surface.points_in_unit)


def test_every_embedding_can_be_chosen() -> None:
    (setting,) = (each for each in fields(EmbeddingOptions) if each.name == "embedding")
    assert tuple(EMBEDDERS) == setting.metadata["choices"]


def test_the_triangle_soup_covers_the_surface_once() -> None:
    surface = surface_of(clouds.torus(3000))
    soup = triangle_soup(surface.points_in_unit, surface.normals, surface.neighbors)
    diagonal = surface_of(clouds.torus(3000)).frame.diagonal
    assert soup.area * diagonal**2 == pytest.approx(4 * np.pi**2 * 0.4, rel=0.03)


@pytest.mark.parametrize("options", BOTH)
def test_a_cylinder_is_stretched_around_but_not_along(options: EmbeddingOptions) -> None:
    points, normals = clouds.cylinder(8000)
    surface = surface_of((points, normals))
    embedded = embed_surface(surface, 2000, options)
    axis = np.tile([0.0, 0, 1], (8000, 1))
    around = stretches(surface, embedded.coordinates, np.cross(normals, axis))
    assert embedded.metric is not None
    # Bending takes some of it.
    wanted = embedded.metric.stretches(np.array(surface.frame.diagonal / 0.5))
    assert 0.7 * wanted < np.median(around) < 1.05 * wanted
    assert np.median(stretches(surface, embedded.coordinates, axis)) < 1.1


@pytest.mark.parametrize("options", BOTH)
def test_a_sphere_is_stretched_alike_in_all_directions(options: EmbeddingOptions) -> None:
    points, normals = clouds.sphere(6000)
    surface = surface_of((points, normals))
    coordinates = embed_surface(surface, 1500, options).coordinates
    south = np.cross(normals, np.cross(normals, [0, 0, 1]))
    south /= np.linalg.norm(south, axis=1, keepdims=True)
    down, across = (stretches(surface, coordinates, each) for each in (south, np.cross(normals, south)))
    assert np.median(down) == pytest.approx(np.median(across), rel=0.05)


@pytest.mark.parametrize("options", BOTH)
def test_a_plane_is_not_stretched(options: EmbeddingOptions) -> None:
    surface = surface_of(clouds.plane(2000))
    psi = embed_surface(surface, 250, options).coordinates[:, 3:]
    assert np.ptp(psi, axis=0).max() < 0.01


def test_the_two_sides_of_a_wall_are_far_apart() -> None:
    points, normals = clouds.hollow_sphere(4000, spacings_thick=3)
    surface = surface_of((points, normals))
    coordinates = embed_surface(surface, 500, EmbeddingOptions()).coordinates
    assert distances_across(coordinates).min() > 4 * np.median(distances_across(surface.points_in_unit))


def test_lengths_follow_the_vertex_budget_unless_given() -> None:
    surface = surface_of(clouds.sphere(2000))

    def chosen(vertices: int, **given: Length) -> dict[str, float]:
        embedded = embed_surface(surface, vertices, EmbeddingOptions(**given))
        return {choice.name: float(choice.value) for choice in embedded.choices}

    few, many = chosen(100), chosen(400)
    assert few.keys() == {"bending_length", "curvature_radius"}
    for name in few:
        assert few[name] == pytest.approx(2 * many[name])
    assert chosen(100, bending_length=Length(1, percent=True)).keys() == {"curvature_radius"}


def embedded(points: clouds.Array, normals: clouds.Array | None = None, threads: int = 0) -> Embedding:
    return embed_points(points, normals, Options(threads=threads, meshing=MeshingOptions(vertices=200)))


def test_points_are_cleaned_and_the_frame_leads_back_to_them() -> None:
    points, normals = clouds.torus(1500)
    dirty = np.vstack([points, points[:9], [[np.nan, 0, 0]]])
    found = embedded(1e6 + dirty, np.vstack([normals, normals[:10]]))
    np.testing.assert_array_equal(found.points, 1e6 + points)
    np.testing.assert_allclose(found.world_from_unit.to_world(found.coordinates[:, :3]), found.points, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(found.normals, axis=1), 1)
    assert {choice.name for choice in found.choices} == {"orient", "bending_length", "curvature_radius"}


def test_threads_do_not_change_the_embedding() -> None:
    points, normals = clouds.torus(1500)
    np.testing.assert_array_equal(
        embedded(points, normals, threads=1).coordinates, embedded(points, normals, threads=3).coordinates
    )


@pytest.mark.parametrize(
    ("points", "normals", "reason"),
    [
        (np.zeros((20, 2)), None, r"points have shape \(20, 2\)"),
        (["a", "b"], None, "points are not numbers"),
        (clouds.sphere(20)[0], np.zeros((20, 4)), r"normals have shape \(20, 4\)"),
        (clouds.sphere(20)[0], np.zeros((19, 3)), "20 points but 19 normals"),
    ],
)
def test_arrays_of_another_shape_are_refused(points: clouds.Array, normals: clouds.Array, reason: str) -> None:
    with pytest.raises(UsageError, match=reason):
        embed_points(points, normals)


def test_progress_can_cancel() -> None:
    with pytest.raises(Interrupted):
        embed_points(clouds.sphere(1000)[0], progress=lambda phase, fraction: phase != "embedding" or fraction < 0.5)


def test_each_row_says_which_of_the_given_points_it_is() -> None:
    given = np.vstack([[np.nan, 0, 0], clouds.torus(800)[0], [9, 9, 9]])
    shuffled = np.random.default_rng(0).permutation(len(given))
    as_given, other = embed_points(given), embed_points(given[shuffled])
    np.testing.assert_array_equal(as_given.points, given[as_given.point_index])
    np.testing.assert_array_equal(other.points, given[shuffled][other.point_index])
    assert set(shuffled[other.point_index]) == set(as_given.point_index) <= set(range(1, 801))
    assert (np.diff(other.point_index) > 0).all()


def test_the_mesh_of_the_same_cloud_is_made_of_the_same_embedding() -> None:
    points = np.random.default_rng(1).permutation(clouds.torus(12_000)[0])
    seen = list[tuple[clouds.Array, clouds.Array]]()

    def watched(surface: Surface, vertices: int, options: EmbeddingOptions, _: object) -> Embedded:
        made = embed_surface(surface, vertices, options)
        seen.append((surface.frame.to_world(surface.points_in_unit), made.coordinates))
        return made

    mesh = reconstruct(points, embedder=watched)
    in_world, coordinates = seen[0]
    alone = embed_points(points)
    same = _core.nearest_neighbors(in_world, alone.points, 1)[:, 0]
    np.testing.assert_array_equal(coordinates[same], alone.coordinates)
    assert "given" in {choice.value for choice in mesh.report.choices if choice.name == "embedding"}
