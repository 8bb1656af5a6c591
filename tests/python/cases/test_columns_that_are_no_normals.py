# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns that are no normals, though they are read as such: estimated instead, and told."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from helpers.clouds import Array, sphere_points
from helpers.files import lines
from helpers.raw_clouds import ELLIPSOID
from helpers.raw_meshes import BALL, area, assert_ball, middles, share_against

from hdpea import reconstruct
from hdpea.reading import read_points

POINTS = 1500
FULL = BALL * ELLIPSOID.prod()


def ellipsoid() -> Array:
    return sphere_points(POINTS, 1) * ELLIPSOID


def red() -> Array:
    return np.tile([1.0, 0, 0], (POINTS, 1))


def labels() -> Array:
    """Return classes, each a column that is 1 where it is the point's."""
    return np.eye(3)[np.random.default_rng(0).integers(0, 3, POINTS)]


def obj_with_its_own_order_of_normals() -> str:
    """Return an OBJ file whose vn are tied to v by its faces alone, as modellers write them."""
    normals = ellipsoid() / ELLIPSOID**2
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    order = np.random.default_rng(5).permutation(POINTS)
    place = np.argsort(order) + 1
    faces = "".join(
        "f " + " ".join(f"{corner + 1}//{place[corner]}" for corner in range(first, first + 3)) + "\n"
        for first in range(0, POINTS - 2, 3)
    )
    return "o S\n" + lines(ellipsoid(), prefix="v ") + lines(normals[order], prefix="vn ") + faces


FILES: dict[str, Callable[[], str]] = {
    "red.xyz": lambda: lines(np.hstack([ellipsoid(), red()])),
    "labels.xyz": lambda: lines(np.hstack([ellipsoid(), labels()])),
    "red.off": lambda: f"COFF\n{POINTS} 0 0\n" + lines(np.hstack([ellipsoid(), red(), np.ones((POINTS, 1))])),
    "order.obj": obj_with_its_own_order_of_normals,
}


@pytest.mark.parametrize("name", FILES)
def test_colours_labels_and_other_orders_do_no_harm(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(FILES[name]())
    assert_ball(reconstruct(read_points(tmp_path / name)), full=FULL)


@pytest.mark.parametrize("columns", [red, labels])
def test_it_is_told_that_they_are_no_normals(columns: Callable[[], Array]) -> None:
    made = reconstruct(ellipsoid(), columns())
    assert_ball(made, full=FULL)
    assert made.report.counts["normals_estimated"] == POINTS
    assert any("normals" in note for note in made.report.notes)


@pytest.mark.parametrize("where", ["region", "random"])
def test_a_constant_in_place_of_a_quarter_of_the_normals_does_no_harm(where: str) -> None:
    ball = sphere_points(4000, 1)
    replaced = ball[:, 0] > 0.5 if where == "region" else np.random.default_rng(0).random(4000) < 0.25
    made = reconstruct(ball, np.where(replaced[:, None], [0, 0, 1.0], ball))
    assert_ball(made)
    assert share_against(made, middles(made)) == 0


def test_lines_of_sight_are_no_normals() -> None:
    ball, sensor = sphere_points(8000, 1), np.array([4.0, 0, 0])
    sight = sensor - ball
    sight /= np.linalg.norm(sight, axis=1, keepdims=True)
    seen = (ball * sight).sum(axis=1) > 0.05
    made = reconstruct(ball[seen], sight[seen])
    mesh = made.report.mesh
    assert (mesh.components, mesh.boundary_loops, mesh.self_intersections) == (1, 1, 0)
    assert area(made) == pytest.approx(4 * np.pi * seen.mean(), rel=0.03)
    assert share_against(made, middles(made)) < 0.002
