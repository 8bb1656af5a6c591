# SPDX-License-Identifier: GPL-3.0-or-later
"""The truth of analytic surfaces, whose curvature is known, however they are cut into triangles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from helpers.analytic_meshes import SURFACES, TORUS, Analytic, Array, Mesh
from helpers.meshes import TETRAHEDRON_FACES, tetrahedron

from hdpea import _core
from hdpea.dataset.ground_truth import EmbeddedMesh, embed_mesh, vertex_normals
from hdpea.dataset.options import GroundTruthOptions
from hdpea.dataset.quality import stretches
from hdpea.errors import CannotReconstruct, UsageError
from hdpea.geometry.triangles import mesh_area
from hdpea.geometry.unit_frame import UnitFrame

VERTICES = {"torus": 2500, "ellipsoid": 3000, "cylinder": 1500, "saddle": 1500, "waves": 2000}
"""For which the curvature radius is a small part of the radii of curvature, and the test is quick."""

# Away from creases and borders, in the coordinates of the surface.
INNER = {
    "cylinder": lambda p: (abs(p[:, 2] - 1) < 0.7) & (np.hypot(p[:, 0], p[:, 1]) > 0.49),
    "saddle": lambda p: (abs(p[:, :2]) < 0.8).all(axis=1),
    "waves": lambda p: (abs(p[:, 0] - 1.5) < 1.25) & (abs(p[:, 1] - 1) < 0.8),
}

everywhere = pytest.mark.parametrize(
    ("name", "tessellation"), [(name, how) for name in SURFACES for how in ("regular", "needles")]
)


@dataclass(frozen=True)
class Case:
    """An embedded surface; `spacing` is the unit of its options' lengths, in the unit frame."""

    surface: Analytic
    options: GroundTruthOptions
    mesh: EmbeddedMesh
    spacing: float

    def curvature(self, points_in_unit: Array) -> tuple[Array, Array]:
        curvatures, direction1 = self.surface.curvature(self.mesh.frame.to_world(points_in_unit))
        return curvatures * self.mesh.frame.diagonal, direction1


@cache
def case(name: str, tessellation: str) -> Case:
    surface, options = SURFACES[name], GroundTruthOptions(vertices=VERTICES[name])
    vertices, faces = surface.mesh(tessellation)
    mesh = embed_mesh(vertices, faces, options)
    return Case(surface, options, mesh, (mesh_area(mesh.frame.to_unit(vertices), faces) / options.vertices) ** 0.5)


def inner(name: str, points: Array) -> Array:
    return INNER[name](points) if name in INNER else np.ones(len(points), bool)


def flat_mesh(seed: int = 0) -> EmbeddedMesh:
    """Return two triangles of a square whose psi and curvatures are random."""
    random = np.random.default_rng(seed)
    vertices, up = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.tile([0.0, 0, 1], (4, 1))
    curvatures = np.sort(random.random((4, 2)))[:, ::-1] + [1, 0]
    angles = random.random(4)
    directions = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    return EmbeddedMesh(vertices, faces, up, random.random((4, 5)), curvatures, directions, UnitFrame(np.zeros(3), 1.0))


def test_the_truth_at_a_vertex_is_that_of_the_vertex() -> None:
    mesh = flat_mesh()
    truth = mesh.at(mesh.vertices)
    np.testing.assert_allclose(truth.psi, mesh.psi, atol=1e-15)
    np.testing.assert_allclose(truth.curvatures, mesh.curvatures, atol=1e-14)
    np.testing.assert_allclose(abs(np.einsum("nc,nc->n", truth.direction1, mesh.direction1)), 1, atol=1e-14)


def test_the_truth_is_linear_along_a_face() -> None:
    mesh = flat_mesh()
    weights = np.random.default_rng(1).dirichlet(np.ones(3), size=50)
    for face in mesh.faces:
        truth = mesh.at(weights @ mesh.vertices[face])
        np.testing.assert_allclose(truth.psi, weights @ mesh.psi[face], atol=1e-14)
        # The trace of the shape operator is linear too, though the curvatures are not.
        np.testing.assert_allclose(truth.curvatures.sum(axis=1), weights @ mesh.curvatures[face].sum(axis=1))


def test_a_point_off_the_surface_has_the_truth_of_the_nearest() -> None:
    mesh, points = flat_mesh(), np.random.default_rng(2).random((50, 3)) * [1, 1, 0]
    np.testing.assert_allclose(mesh.at(points + np.array([0, 0, 0.3])).psi, mesh.at(points).psi, atol=1e-15)
    np.testing.assert_allclose(mesh.at(np.array([[-2.0, -1, 1]])).psi, mesh.psi[:1])


@pytest.mark.slow
@everywhere
def test_the_curvature_is_that_of_the_surface(name: str, tessellation: str) -> None:
    of = case(name, tessellation)
    known, direction1 = of.curvature(of.mesh.vertices)
    radius = of.options.curvature_radius * of.spacing
    wide = inner(name, of.mesh.frame.to_world(of.mesh.vertices)) & (abs(known[:, 0]) * radius < 1 / 3)
    assert wide.mean() > 0.5
    off = abs(of.mesh.curvatures - known)[wide] / abs(known[wide, :1])
    assert (np.median(off, axis=0) < 0.05).all()
    apart = wide & (abs(known[:, 0]) - abs(known[:, 1]) > 0.2 * abs(known[:, 0]))
    cosines = abs(np.einsum("nc,nc->n", of.mesh.direction1, direction1))[apart]
    assert np.degrees(np.arccos(np.median(cosines))) < 5


@pytest.mark.slow
@everywhere
def test_the_stretch_is_that_of_the_metric(name: str, tessellation: str) -> None:
    of = case(name, tessellation)
    mesh = of.mesh
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    known, direction1 = of.curvature(middles)
    # The bending term leaves alone what bends over more than its length.
    allowed = abs(known[:, 0]) * of.options.bending_length * of.spacing < 1 / 3
    allowed &= inner(name, mesh.frame.to_world(middles))
    assert allowed.mean() > 0.5
    got = _stretches_of_faces(mesh, direction1)
    wanted = stretches(known, of.options, of.spacing)
    assert (np.median(abs(got / wanted - 1)[allowed], axis=0) < 0.15).all()


def _stretches_of_faces(mesh: EmbeddedMesh, direction1: Array) -> Array:
    """Return by how much x -> [x, psi(x)] stretches each face along, and across, a direction (f, 3)."""
    corners = np.hstack([mesh.vertices, mesh.psi])[mesh.faces]
    edges = corners[:, 1:] - corners[:, :1]
    normals = np.cross(edges[:, 0, :3], edges[:, 1, :3])
    across = np.cross(normals, direction1)
    lengths = []
    for way in (np.cross(across, normals), across):
        unit = way / np.linalg.norm(way, axis=1, keepdims=True)
        # The direction as a sum of edges, by least squares, then the same sum in R^8.
        in_edges = np.einsum("fij,fj->fi", np.linalg.pinv(edges[:, :, :3].transpose(0, 2, 1)), unit)
        lengths.append(np.linalg.norm(np.einsum("fi,fic->fc", in_edges, edges), axis=1))
    return np.stack(lengths, axis=1)


@pytest.mark.slow
@pytest.mark.parametrize("tessellation", ["regular", "needles"])
def test_an_open_surface_keeps_its_border(tessellation: str) -> None:
    of = case("saddle", tessellation)
    check = _core.check_mesh(of.mesh.vertices, of.mesh.faces)
    assert (check.boundary_loops, check.euler_characteristic, check.manifold) == (1, 1, True)
    edges = np.sort(of.mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    distinct, counts = np.unique(edges, axis=0, return_counts=True)
    border = of.mesh.frame.to_world(of.mesh.vertices[np.unique(distinct[counts == 1])])
    np.testing.assert_allclose(abs(border[:, :2]).max(axis=1), 1, atol=1e-9)
    for corner in ([-1, -1], [-1, 1], [1, -1], [1, 1]):
        assert np.linalg.norm(border[:, :2] - corner, axis=1).min() < 1e-9


def small_torus() -> Mesh:
    vertices, faces = Analytic(TORUS.level, TORUS.point, (48, 24), (48, 24), TORUS.wraps).mesh("regular")
    # Not symmetric, so that rounding has no ties to decide.
    return vertices + 0.01 * np.random.default_rng(0).normal(size=vertices.shape), faces


def test_scale_and_place_in_the_world_do_not_matter() -> None:
    options = GroundTruthOptions(vertices=200)
    vertices, faces = small_torus()
    one = embed_mesh(vertices, faces, options)
    other = embed_mesh(1000 * vertices + [5, -3000, 70], faces, options)
    np.testing.assert_array_equal(other.faces, one.faces)
    np.testing.assert_allclose(other.psi, one.psi, atol=1e-5)
    np.testing.assert_allclose(other.curvatures, one.curvatures, atol=1e-3)
    assert other.frame.diagonal == pytest.approx(1000 * one.frame.diagonal)


def test_a_mesh_that_is_no_surface_is_refused() -> None:
    corners, faces = tetrahedron(), TETRAHEDRON_FACES
    turned = faces.copy()
    turned[0] = turned[0, ::-1]
    with pytest.raises(UsageError, match="of one orientation"):
        embed_mesh(corners, turned)
    fin = np.vstack([corners, [2.0, 2.0, 2.0]])
    with pytest.raises(UsageError, match="at most two faces to an edge"):
        embed_mesh(fin, np.vstack([faces, [0, 1, 4]]))
    with pytest.raises(CannotReconstruct, match="no area"):
        embed_mesh(np.outer(np.arange(4.0), [1, 2, 3]), faces)
    with pytest.raises(CannotReconstruct, match="equal"):
        embed_mesh(np.ones((4, 3)), faces)


def test_normals_of_vertices_are_means_by_area() -> None:
    vertices, faces = SURFACES["ellipsoid"].mesh("regular")
    normals = vertex_normals(vertices, faces)
    true = vertices / [1, 0.36, 0.16]
    true /= np.linalg.norm(true, axis=1, keepdims=True)
    assert np.einsum("vc,vc->v", normals, true).min() > 0.99
    assert mesh_area(vertices, faces) == pytest.approx(5.39, rel=0.002)
