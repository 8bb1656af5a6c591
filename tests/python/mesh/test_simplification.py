# SPDX-License-Identifier: GPL-3.0-or-later
"""Small meshes are simplified from the particles that the points can show."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds
from helpers.reconstructions import cloud_of, options

from hdpea import Reconstruction, _core, reconstruct
from hdpea.errors import Interrupted, UsageError
from hdpea.options import MeshingOptions, Options, ParticleOptions
from hdpea.options.lengths import Length
from hdpea.options.points_shown import PointsShown

DENOISED = PointsShown(40_000, exact=False, denoised=True)


def thin_ring(count: int) -> clouds.Cloud:
    """Return points of a torus whose tube is 30 times thinner than the ring."""
    u, v = 2 * np.pi * np.random.default_rng(0).random((2, count))
    radial = np.stack([np.cos(u), np.sin(u), 0 * u], axis=1)
    normals = np.cos(v)[:, None] * radial + np.sin(v)[:, None] * [0, 0, 1]
    return radial + normals / 30, normals


def is_ring(made: Reconstruction) -> bool:
    mesh = made.report.mesh
    return mesh is not None and mesh.closed and (mesh.components, mesh.genus) == (1, 1)


def test_a_thin_ring_needs_more_particles_than_vertices() -> None:
    wanted = MeshingOptions(vertices=40)
    made = reconstruct(*thin_ring(8000), Options(meshing=wanted))
    assert is_ring(made)
    assert len(made.vertices) == 40
    assert made.report.meshing["edges_collapsed"] > 800
    few = reconstruct(*thin_ring(8000), Options(meshing=wanted, particles=ParticleOptions(particles=40)))
    assert not is_ring(few)


@pytest.mark.parametrize("shape", ["sphere", "cube", "torus"])
def test_what_is_closed_stays_closed(shape: str) -> None:
    made = reconstruct(*cloud_of(shape), options(100))
    assert len(made.vertices) == 100
    assert made.report.mesh.closed
    assert made.report.mesh.genus == (1 if shape == "torus" else 0)


def test_what_is_open_stays_open() -> None:
    made = reconstruct(*cloud_of("cylinder"), options(110))
    assert (made.report.mesh.boundary_loops, made.report.mesh.components) == (2, 1)
    fine = reconstruct(*cloud_of("cylinder"), options(375))
    np.testing.assert_allclose(np.ptp(made.vertices, axis=0), np.ptp(fine.vertices, axis=0), rtol=0.01)


def test_a_cube_of_few_vertices_keeps_its_corners() -> None:
    points, normals = cloud_of("cube", 6000)
    made = reconstruct(points, normals, options(60))
    corners = np.array(np.meshgrid(*np.stack([points.min(axis=0), points.max(axis=0)], axis=1))).reshape(3, 8).T
    distance = _core.closest_surface_points(made.vertices, made.faces, np.ascontiguousarray(corners)).distance
    assert distance.max() < 0.02 * np.ptp(points)


@pytest.mark.parametrize(("asked", "made"), [(300, 300), (51, 50)])
def test_a_number_of_faces_is_met(asked: int, made: int) -> None:
    mesh = reconstruct(*cloud_of("torus"), options(None, faces=asked))
    assert len(mesh.faces) == made  # a closed mesh has an even number
    assert mesh.report.missed == []


def test_pieces_are_dropped_by_their_share_of_the_small_mesh() -> None:
    points, normals = clouds.sphere(3000)
    crumb, out = clouds.sphere(100)
    both = np.vstack([points, [3, 0, 0] + 0.3 * crumb]), np.vstack([normals, out])
    for vertices, pieces in (375, 2), (60, 1):
        mesh = reconstruct(*both, options(vertices)).report.mesh
        assert mesh is not None
        assert mesh.components == pieces


@pytest.mark.parametrize(
    ("points", "vertices", "particles"),
    [
        (40_000, None, 13_333),
        (40_000, 1_500, 13_333),
        (40_000, 11_000, 13_333),
        (40_000, 12_000, 12_000),
        (10**6, 100, 20_000),
        (10**6, 35_000, 70_000),
    ],
)
def test_particles_are_as_many_as_the_points_can_show(points: int, vertices: int | None, particles: int) -> None:
    wanted = Options(meshing=MeshingOptions(vertices=vertices))
    assert wanted.particles_of(points) == particles


@pytest.mark.parametrize(("vertices", "particles"), [(1_500, 5_000), (4_500, 4_500), (5_000, 5_000)])
def test_what_is_not_exact_shows_no_more_than_as_many_vertices_do(vertices: int, particles: int) -> None:
    wanted = Options(meshing=MeshingOptions(vertices=vertices))
    assert wanted.particles_of(40_000, PointsShown(40_000, exact=False)) == wanted.resolution_of(40_000) == particles


@pytest.mark.parametrize(
    ("meshing", "particles"),
    [
        (MeshingOptions(), 10_000),
        (MeshingOptions(vertices=1_500), 10_000),
        (MeshingOptions(vertices=9_000), 13_333),
        (MeshingOptions(error=Length(1, percent=True)), 5_000),
        (MeshingOptions(watertight=True), 5_000),
    ],
)
def test_denoised_points_get_more_so_that_less_tears(meshing: MeshingOptions, particles: int) -> None:
    assert Options(meshing=meshing).particles_of(40_000, DENOISED) == particles


def test_denoised_points_on_lines_show_no_more_than_as_many_vertices_do() -> None:
    assert Options().particles_of(20_000, DENOISED) == Options().vertices_of(40_000) == 5_000


def test_more_vertices_than_points_show_are_made_of_more_particles_all_the_same() -> None:
    assert Options(meshing=MeshingOptions(vertices=1_000)).particles_of(4_000, PointsShown(4_000, exact=False)) == 1_333


def test_particles_that_are_given_are_taken() -> None:
    given = Options(meshing=MeshingOptions(vertices=500), particles=ParticleOptions(particles=800))
    assert (given.vertices_of(40_000), given.particles_of(40_000)) == (500, 800)
    alone = Options(particles=ParticleOptions(particles=800))
    assert (alone.vertices_of(40_000), alone.particles_of(40_000)) == (800, 800)


@pytest.mark.parametrize("budget", [MeshingOptions(vertices=500), MeshingOptions(faces=996)])
def test_fewer_particles_than_vertices_are_refused(budget: MeshingOptions) -> None:
    with pytest.raises(UsageError, match="400 particles cannot make 500 vertices"):
        Options(meshing=budget, particles=ParticleOptions(particles=400))


def test_more_particles_than_points_are_refused() -> None:
    wanted = Options(meshing=MeshingOptions(vertices=100), particles=ParticleOptions(particles=301))
    with pytest.raises(UsageError, match="301 particles were asked for, but there are 300 distinct points"):
        reconstruct(*cloud_of("sphere", 300), wanted)


def test_the_report_says_so() -> None:
    told = {choice.name: choice for choice in reconstruct(*cloud_of("sphere"), options(100)).report.choices}
    assert told["particles"].value == 1000
    assert "simplified" in told["particles"].why


def test_it_can_be_interrupted_halfway() -> None:
    told = []

    def stop_halfway(phase: str, fraction: float) -> bool:
        told.append((phase, fraction))
        return phase != "simplification" or fraction < 0.5

    with pytest.raises(Interrupted):
        reconstruct(*cloud_of("sphere"), options(100), stop_halfway)
    phase, fraction = told[-1]
    assert phase == "simplification"
    assert fraction < 1
