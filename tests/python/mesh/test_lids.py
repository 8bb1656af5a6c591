# SPDX-License-Identifier: GPL-3.0-or-later
"""What closes a hole far from all points, across the surface, is opened again; what continues the surface is not."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import TAU, Array, sphere_points

from hdpea import reconstruct
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.mesh.extraction import Mesh
from hdpea.mesh.lids import without_lids
from hdpea.surface.surface import Surface


def pipe(count: int, length: float = 6, seed: int = 0) -> Array:
    """Return points of a pipe of radius 1."""
    random = np.random.default_rng(seed)
    around, along = TAU * random.random(count), length * random.random(count)
    return np.stack([np.cos(around), np.sin(around), along], axis=1)


# The rims of the last zigzag along the pipe, so that faces of a lid go on along it.
@pytest.mark.parametrize(("count", "length", "seed"), [(1000, 6, 0), (4000, 6, 0), (4000, 20, 2)])
def test_the_mouths_of_a_pipe_stay_open(count: int, length: float, seed: int) -> None:
    mesh = reconstruct(pipe(count, length, seed)).report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 2, 0)


# They have 12 to 20 points around.
@pytest.mark.parametrize(("count", "length"), [(500, 8), (600, 20), (1000, 40), (3000, 80)])
def test_so_do_those_of_few_points(count: int, length: float) -> None:
    mesh = reconstruct(pipe(count, length)).report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 2, 0)


@pytest.mark.parametrize("count", [300, 500, 800])
def test_the_ends_of_a_closed_cylinder_stay_closed(count: int) -> None:
    ends = np.random.default_rng(1).choice([0.0, 8], count // 8)
    around, out = TAU * np.random.default_rng(2).random(len(ends)), np.sqrt(np.random.default_rng(3).random(len(ends)))
    lids = np.stack([out * np.cos(around), out * np.sin(around), ends], axis=1)
    assert reconstruct(np.vstack([pipe(count, 8), lids])).report.mesh.closed


def test_they_are_closed_if_that_is_asked_for() -> None:
    assert reconstruct(pipe(1000), fill_holes=3.0).report.mesh.closed
    assert reconstruct(pipe(1000), watertight=True).report.mesh.closed


def test_a_hole_that_the_surface_continues_over_is_closed() -> None:
    points = sphere_points(3000, 1)
    made = reconstruct(points[points[:, 2] < np.cos(4 * np.sqrt(TAU * 2 / 3000))])
    assert made.report.mesh.closed
    assert made.report.meshing["area_filled"] > 0


def plate_with_a_bulge(length: int, width: int, out: float) -> tuple[Mesh, Surface]:
    """Return a plate of thickness 1 whose rim is a patch, drawn out in one place, and points of its sides."""
    x, y = np.meshgrid(np.arange(length + 1.0), np.arange(width + 1.0), indexing="ij")
    side = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    points = np.vstack([side + np.array([0, 0, 1]), side])
    normals = np.repeat([[0.0, 0, 1], [0, 0, -1]], len(side), axis=0)
    number = np.arange(len(side)).reshape(x.shape)
    a, b, c, d = (each.ravel() for each in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    top = np.vstack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    rim = np.concatenate([number[:-1, 0], number[-1, :-1], number[:0:-1, -1], number[0, :0:-1]])
    below, ahead = rim + len(side), np.roll(rim, -1)
    walls = np.vstack([np.stack([below, ahead, rim], 1), np.stack([below, ahead + len(side), ahead], 1)])
    first, tip = length // 2, len(points)
    corners = [below[first], below[first + 1], ahead[first], rim[first]]
    bulge = np.array([[one, other, tip] for one, other in zip(corners, np.roll(corners, -1), strict=True)])
    walls = np.vstack([np.delete(walls, [first, first + len(rim)], axis=0), bulge])
    vertices = np.vstack([points, [first + 0.5, -out, 0.5]])
    faces = np.vstack([top, top[:, ::-1] + len(side), walls])
    counts = {"holes_filled": 1, "holes_left": 0}
    mesh = Mesh(vertices, faces, vertices, counts, patches=vertices[walls])
    frame = UnitFrame(np.zeros(3), 1.0)
    return mesh, Surface.of(frame, points, normals)


@pytest.mark.parametrize(("length", "stays"), [(200, True), (6, False)])
def test_a_long_patch_that_is_far_from_points_in_one_place_stays(length: int, stays: bool) -> None:
    mesh, surface = plate_with_a_bulge(length, 6, 8)
    assert (len(without_lids(mesh, surface).faces) == len(mesh.faces)) == stays
