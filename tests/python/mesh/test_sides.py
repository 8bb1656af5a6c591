# SPDX-License-Identifier: GPL-3.0-or-later
"""Finished pieces: closed ones face out whatever they touch, walls of cavities into these, and guesses are told."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from helpers import clouds

from hdpea import reconstruct
from hdpea.geometry.triangles import area_vectors
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.sides import facing_out

Array = clouds.Array

TETRAHEDRON = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
CORNERS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])


def mesh_of(*pieces: tuple[Array, Array]) -> Mesh:
    vertices = np.vstack([vertices for vertices, _ in pieces])
    faces = np.vstack([faces + len(CORNERS) * i for i, (_, faces) in enumerate(pieces)])
    return Mesh(vertices, faces, vertices)


def volume(vertices: Array, faces: Array) -> float:
    return float(np.einsum("fc,fc->", vertices[faces[:, 0]], area_vectors(vertices, faces)) / 3)


INSIDE_OUT = TETRAHEDRON[:, ::-1]
SMALL = 0.1 * CORNERS + 0.2


@pytest.mark.parametrize("faces", [TETRAHEDRON, INSIDE_OUT])
def test_a_closed_piece_faces_out(faces: Array) -> None:
    faced = facing_out(mesh_of((CORNERS, faces), (CORNERS + 5, faces)))
    assert volume(faced.mesh.vertices_in_unit, faced.mesh.faces) == pytest.approx(2 / 6)
    assert faced.mesh.statistics["pieces_turned"] == (2 if faces is INSIDE_OUT else 0)
    assert not faced.notes


@pytest.mark.parametrize("outer", [TETRAHEDRON, INSIDE_OUT])
@pytest.mark.parametrize("inner", [TETRAHEDRON, INSIDE_OUT])
def test_within_another_piece_a_side_is_kept(outer: Array, inner: Array) -> None:
    faces = facing_out(mesh_of((CORNERS, outer), (SMALL, inner))).mesh.faces
    np.testing.assert_array_equal(np.sort(faces[4:], axis=0), np.sort(inner + 4, axis=0))
    assert volume(CORNERS, faces[:4]) == pytest.approx(1 / 6)


@pytest.mark.parametrize("inner", [TETRAHEDRON, INSIDE_OUT])
def test_that_it_may_be_a_room_is_said_of_what_looks_like_a_cavity(inner: Array) -> None:
    notes = facing_out(mesh_of((CORNERS, TETRAHEDRON), (SMALL, inner))).notes
    assert any("a guess; in a room" in note for note in notes) == (inner is INSIDE_OUT)


def test_so_it_is_of_one_that_has_a_small_gap() -> None:
    vertices, faces = SMALL, INSIDE_OUT
    for _ in range(4):
        vertices, faces = trimesh.remesh.subdivide(vertices, faces)
    both = np.vstack([CORNERS, vertices])
    notes = facing_out(Mesh(both, np.vstack([TETRAHEDRON, faces[1:] + len(CORNERS)]), both)).notes
    assert any("a guess; in a room" in note for note in notes)


@pytest.mark.parametrize("inner", [TETRAHEDRON, INSIDE_OUT])
def test_within_an_open_piece_a_closed_one_faces_out(inner: Array) -> None:
    outer = TETRAHEDRON[:3]
    faces = facing_out(mesh_of((CORNERS, outer), (SMALL, inner))).mesh.faces
    np.testing.assert_array_equal(faces[:3], outer)
    assert volume(SMALL, faces[3:] - 4) == pytest.approx(1e-3 / 6)


def test_a_wall_of_a_cavity_is_kept_though_the_piece_around_it_has_a_gap() -> None:
    """A tetrahedron of 1,024 faces of which one is missing holds what is in it."""
    vertices, faces = CORNERS, TETRAHEDRON
    for _ in range(4):
        vertices, faces = trimesh.remesh.subdivide(vertices, faces)
    both = np.vstack([vertices, SMALL])
    made = Mesh(both, np.vstack([faces[1:], INSIDE_OUT + len(vertices)]), both)
    np.testing.assert_array_equal(facing_out(made).mesh.faces, made.faces)


def test_an_open_piece_keeps_its_side_and_is_a_guess_if_it_has_no_inside() -> None:
    for faces in (TETRAHEDRON[:2], INSIDE_OUT[:2]):
        faced = facing_out(mesh_of((CORNERS, faces)))
        np.testing.assert_array_equal(faced.mesh.faces, faces)
        assert any("is a guess" in note for note in faced.notes)


def test_balls_that_touch_are_two_that_face_out() -> None:
    ball = clouds.sphere_points(4000, 1)
    made = reconstruct(np.vstack([ball, clouds.sphere_points(4000, 2) + np.array([2.0, 0, 0])]))
    facts = made.report.mesh
    assert (facts.closed, facts.components, facts.genus) == (True, 2, 0)
    assert volume(made.vertices, made.faces) == pytest.approx(8 / 3 * np.pi, rel=0.01)


def test_a_ball_on_a_plane_faces_out_and_the_plane_is_a_guess() -> None:
    plane = 6 * (clouds.plane(8000)[0] - 0.5) * [1, 1, 0] - [0, 0, 1]
    made = reconstruct(np.vstack([clouds.sphere_points(4000, 1), plane]))
    corners = made.vertices[made.faces]
    of_ball = (corners[:, :, 2] > -0.8).all(axis=1)
    outward = np.einsum("fc,fc->f", corners.mean(axis=1), area_vectors(made.vertices, made.faces)) > 0
    assert outward[of_ball].all()
    assert any("is a guess" in note for note in made.report.notes)


def test_a_side_that_the_file_says_is_kept() -> None:
    ball = clouds.sphere_points(2000)
    made = reconstruct(ball, -ball)
    assert volume(made.vertices, made.faces) == pytest.approx(-4 / 3 * np.pi, rel=0.01)
    assert "pieces_turned" not in made.report.meshing


@pytest.mark.parametrize("sign", [1, -1])
def test_normals_that_face_in_are_taken_and_told(sign: int) -> None:
    points, normals = clouds.sphere(2000)
    made = reconstruct(points, sign * normals)
    assert np.sign(volume(made.vertices, made.faces)) == sign
    assert any("faces inwards, as the given normals do" in note for note in made.report.notes) == (sign < 0)
    turned = reconstruct(points, sign * normals, orient="wnnc")
    assert volume(turned.vertices, turned.faces) > 0
