# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles: evenly spread, and on the surface they are to stand for."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from helpers import clouds

from hdpea import _core
from hdpea.embedding import embed_surface
from hdpea.embedding.tangents import tangent_bases
from hdpea.errors import Interrupted
from hdpea.mesh.particles import Particles, spread_particles
from hdpea.options import EmbeddingOptions, ParticleOptions
from hdpea.surface.normals import oriented_surface
from hdpea.surface.surface import Surface


@dataclass(frozen=True)
class Embedded:
    surface: Surface
    coordinates: clouds.Array
    bases: clouds.Array

    def spread(self, count: int, iterations: int = 100, seed: int = 0) -> Particles:
        options = ParticleOptions(iterations=iterations, seed=seed)
        return spread_particles(self.coordinates, self.bases, self.surface.neighbors, count, options=options)


@cache
def embedded(shape: str, points: int = 3000) -> Embedded:
    surface = oriented_surface(*getattr(clouds, shape)(points)).surface
    coordinates = embed_surface(surface, points // 8, EmbeddingOptions()).coordinates
    return Embedded(surface, coordinates, tangent_bases(coordinates, surface.normals, surface.neighbors))


def nearest_distances(x: clouds.Array) -> clouds.Array:
    return np.linalg.norm(x[_core.nearest_neighbors(x, 1)[:, 0]] - x, axis=1)


def variation(x: clouds.Array) -> float:
    distances = nearest_distances(x)
    return float(distances.std() / distances.mean())


@pytest.mark.parametrize("shape", ["sphere", "torus", "ellipsoid", "box", "cylinder", "plane"])
def test_spacings_hardly_vary(shape: str) -> None:
    start, spread = (variation(embedded(shape).spread(375, iterations=each).coordinates) for each in (0, 100))
    assert spread < 0.06
    assert start > 1.5 * spread


def test_particles_spread_beside_those_that_are_placed() -> None:
    cloud = embedded("sphere")
    whole = cloud.spread(375)
    left = whole.coordinates[:, 0] < 0
    placed = Particles(whole.coordinates[left], whole.nearest[left])
    count, free = int((~left).sum()), cloud.coordinates[:, 0] >= 0
    others = spread_particles(cloud.coordinates, cloud.bases, cloud.surface.neighbors, count, placed=placed, free=free)
    assert (others.coordinates[:, 0] > -0.1).all()
    assert variation(np.vstack([placed.coordinates, others.coordinates])) < 0.09


def test_tangent_bases_are_orthonormal_and_tangent() -> None:
    cloud = embedded("sphere")
    np.testing.assert_allclose(
        cloud.bases @ cloud.bases.transpose(0, 2, 1), np.tile(np.eye(2), (3000, 1, 1)), atol=1e-9
    )
    in_space = tangent_bases(cloud.surface.points_in_unit, cloud.surface.normals, cloud.surface.neighbors)
    assert abs(in_space @ cloud.surface.normals[:, :, None]).max() < 0.2


@pytest.mark.parametrize("shape", ["sphere", "cylinder", "plane"])
def test_particles_lie_in_the_tangent_plane_of_their_nearest_point(shape: str) -> None:
    cloud = embedded(shape)
    particles = cloud.spread(375)
    offset = particles.coordinates - cloud.coordinates[particles.nearest]
    basis = cloud.bases[particles.nearest]
    in_plane = ((offset[:, None] @ basis.transpose(0, 2, 1)) @ basis)[:, 0]
    np.testing.assert_allclose(offset, in_plane, atol=1e-12)


@pytest.mark.parametrize("shape", ["cylinder", "plane"])
def test_particles_stay_on_open_surfaces(shape: str) -> None:
    cloud = embedded(shape)
    points = cloud.surface.points_in_unit
    x = cloud.spread(375).coordinates[:, :3]
    beyond = np.maximum(points.min(axis=0) - x, x - points.max(axis=0)).max()
    # The surface ends somewhere beyond its last points; how far, their spacing says roughly.
    area = np.pi * 2 if shape == "cylinder" else 1.0
    spacing = np.sqrt(area / len(points)) / cloud.surface.frame.diagonal
    assert beyond < 2 * spacing


def test_as_many_particles_as_points() -> None:
    assert len(embedded("sphere", 300).spread(300, iterations=5).coordinates) == 300


def test_the_seed_decides_where_they_begin() -> None:
    first, again, other = (embedded("torus").spread(100, seed=seed).coordinates for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


def test_progress_can_cancel() -> None:
    cloud, told = embedded("sphere", 300), []

    def stop_halfway(fraction: float) -> bool:
        told.append(fraction)
        return fraction < 0.5

    with pytest.raises(Interrupted):
        spread_particles(cloud.coordinates, cloud.bases, cloud.surface.neighbors, 40, progress=stop_halfway)
    assert told == sorted(told)
    assert told[-1] == 0.5
