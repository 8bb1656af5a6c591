# SPDX-License-Identifier: GPL-3.0-or-later
"""What kind of surface comes out: closed or open, in how many pieces, with which holes and how many faces."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds
from helpers.reconstructions import VERTICES, area_vectors, edges, euler_characteristic, mesh_of, options, volume

from hdpea import reconstruct
from hdpea.options import MeshingOptions, Options
from hdpea.options.lengths import Length

VOLUMES = {
    "sphere": 4 / 3 * np.pi,
    "torus": 2 * np.pi**2 * 0.4**2,
    "ellipsoid": 4 / 3 * np.pi * 0.6 * 0.4,
    "cube": 1,
    "plate": 0.1,
}


@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_closed_shapes_come_out_closed_and_outside_out(shape: str) -> None:
    mesh = mesh_of(shape)
    found = mesh.report.mesh
    assert found is not None
    assert (found.manifold, found.closed, found.components, found.boundary_loops) == (True, True, 1, 0)
    assert found.genus == clouds.GENUS[shape]
    assert found.self_intersections == 0
    assert volume(mesh) == pytest.approx(VOLUMES[shape], rel=0.03)


@pytest.mark.parametrize("shape", [*clouds.CLOSED, "cylinder", "plane"])
def test_the_facts_are_true(shape: str) -> None:
    mesh = mesh_of(shape)
    found = mesh.report.mesh
    assert found is not None
    directed = edges(mesh.faces)
    assert len(np.unique(directed, axis=0)) == len(directed)  # oriented, no edge of three faces
    faces_at = np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)[1]
    assert found.closed == (faces_at == 2).all()
    assert (found.vertices, found.faces) == (len(mesh.vertices), len(mesh.faces))
    assert len(np.unique(mesh.faces)) == len(mesh.vertices)
    if found.genus is not None:
        assert euler_characteristic(mesh) == 2 - 2 * found.genus


def test_an_open_cylinder_keeps_exactly_its_two_borders() -> None:
    mesh = mesh_of("cylinder")
    found = mesh.report.mesh
    assert found is not None
    assert (found.closed, found.components, found.boundary_loops, found.genus) == (False, 1, 2, None)
    assert euler_characteristic(mesh) == 0
    radii = np.linalg.norm(mesh.vertices[:, :2], axis=1)
    assert abs(radii - 0.5).max() < 0.01  # nothing lies across the ends


def test_a_plane_is_one_flat_sheet_that_faces_as_its_points() -> None:
    mesh = mesh_of("plane")
    found = mesh.report.mesh
    assert found is not None
    assert (found.components, found.boundary_loops) == (1, 1)
    assert euler_characteristic(mesh) == 1
    assert abs(mesh.vertices[:, 2]).max() < 1e-9
    assert area_vectors(mesh)[:, 2].min() > 0
    assert area_vectors(mesh)[:, 2].sum() == pytest.approx(1, rel=0.1)


@pytest.mark.parametrize("count", [16, 40, 100])
def test_a_plane_of_few_points_is_one_flat_sheet_too(count: int) -> None:
    points, normals = clouds.plane(count)
    found = reconstruct(points, normals).report.mesh
    assert found is not None
    assert (found.components, found.boundary_loops, found.self_intersections) == (1, 1, 0)


@pytest.mark.parametrize("facing", [1, -1])
@pytest.mark.parametrize("points", [3000, 5000])
def test_two_sheets_three_spacings_apart_stay_two(facing: int, points: int) -> None:
    mesh = reconstruct(*clouds.two_sheets(points, 3, facing))
    found = mesh.report.mesh
    assert found is not None
    assert (found.components, found.boundary_loops) == (2, 2)
    heights = mesh.vertices[mesh.faces][:, :, 2]
    middle = 1.5 * (2 / points) ** 0.5
    above = heights.mean(axis=1) > middle
    assert ((heights > middle) == above[:, None]).all()
    # Each sheet is covered, and faces the way its points do.
    for sheet, sign in ((~above, facing), (above, 1)):
        assert (sign * area_vectors(mesh)[sheet, 2]).sum() == pytest.approx(1, rel=0.15)


def sphere_without(cap: float) -> clouds.Cloud:
    """Return a unit sphere without what lies above a height."""
    points, normals = clouds.sphere(3500)
    kept = points[:, 2] < cap
    return points[kept], normals[kept]


def holes_left(cap: float, **meshing: object) -> int:
    found = reconstruct(*sphere_without(cap), options(**meshing)).report.mesh  # type: ignore[arg-type]
    assert found is not None
    return found.boundary_loops


def test_small_holes_are_filled_and_large_ones_are_not() -> None:
    # Sampled by 3,500 points, with 400 vertices: the vertices are 0.18 apart.
    small, large = 0.95, 0.8  # holes 0.62 and 1.2 across
    assert holes_left(small) == 0
    assert holes_left(small, fill_holes=Length(0)) == 1
    assert holes_left(large) == 1


def test_fill_holes_is_a_size_across() -> None:
    across = 1.2
    assert holes_left(0.8, fill_holes=Length(0.8 * across)) == 1
    assert holes_left(0.8, fill_holes=Length(1.2 * across)) == 0


@pytest.mark.parametrize("shape", ["cylinder", "plane"])
def test_watertight_closes_everything(shape: str) -> None:
    mesh = mesh_of(shape, watertight=True)
    assert mesh.report.mesh.closed
    assert mesh.report.missed == []
    assert mesh.report.meshing["holes_left"] == 0


@pytest.mark.parametrize("shape", ["torus", "cylinder", "cube"])
@pytest.mark.parametrize("wanted", [100, 250, 1000])
def test_the_budget_is_met_within_one_percent(shape: str, wanted: int) -> None:
    points, normals = (clouds.CLOSED.get(shape) or getattr(clouds, shape))(3000)
    by_vertices = reconstruct(points, normals, options(vertices=wanted))
    by_faces = reconstruct(points, normals, Options(meshing=MeshingOptions(faces=wanted)))
    assert len(by_vertices.vertices) == pytest.approx(wanted, rel=0.01)
    assert len(by_faces.faces) == pytest.approx(wanted, rel=0.01)
    assert by_vertices.report.missed == by_faces.report.missed == []


def test_every_candidate_is_accounted_for() -> None:
    found = mesh_of("cube").report.meshing
    refused = sum(count for name, count in found.items() if name.startswith("refused_"))
    assert found["t3"] + found["t12"] == found["t3_kept"] + found["t12_kept"] + refused
    assert found["t3"] > 0.9 * 2 * VERTICES


def test_small_pieces_are_dropped_but_not_the_largest() -> None:
    points, normals = clouds.sphere(2000)
    crumb, out = clouds.sphere(60)
    both = np.vstack([points, [3, 0, 0] + 0.2 * crumb]), np.vstack([normals, out])
    kept = reconstruct(*both, options(min_component=0)).report
    dropped = reconstruct(*both, options(min_component=100)).report
    assert kept.mesh is not None
    assert dropped.mesh is not None
    assert (kept.mesh.components, dropped.mesh.components) == (2, 1)
    assert dropped.meshing["dropped_components"] == 1
    assert reconstruct(points, normals, options(min_component=10**6)).report.meshing["dropped_components"] == 0
