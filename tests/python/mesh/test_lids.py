# SPDX-License-Identifier: GPL-3.0-or-later
"""What closes a hole far from all points, across the surface, is opened again; what continues the surface is not."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import TAU, Array, sphere_points

from hdpea import reconstruct


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


def test_they_are_closed_if_that_is_asked_for() -> None:
    assert reconstruct(pipe(1000), fill_holes=3.0).report.mesh.closed
    assert reconstruct(pipe(1000), watertight=True).report.mesh.closed


def test_a_hole_that_the_surface_continues_over_is_closed() -> None:
    points = sphere_points(3000, 1)
    made = reconstruct(points[points[:, 2] < np.cos(4 * np.sqrt(TAU * 2 / 3000))])
    assert made.report.mesh.closed
    assert made.report.meshing["area_filled"] > 0
