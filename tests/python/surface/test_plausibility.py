# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions that are no normals: colours, labels, lines of sight, normals of other points."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea.options import NormalOptions
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.surface.normals import oriented_surface
from hdpea.surface.plausibility import are_normals
from hdpea.surface.preparation import prepare_surface

COUNT = 2000


def lines_of_sight(points: clouds.Array) -> clouds.Array:
    return unit(np.array([4.0, 0.5, 0.2]) - points)


def unit(vectors: clouds.Array) -> clouds.Array:
    lengths: clouds.Array = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / lengths


def mistaken(kind: str, points: clouds.Array, normals: clouds.Array) -> clouds.Array:
    random = np.random.default_rng(5)
    directions: clouds.Array = {
        "one colour": np.tile([1.0, 0.0, 0.0], (len(points), 1)),
        "labels": np.eye(3)[random.integers(0, 3, len(points))],
        "lines of sight": lines_of_sight(points),
        "of other points": random.permutation(normals),
    }[kind]
    return directions


@pytest.mark.parametrize("kind", ["one colour", "labels", "lines of sight", "of other points"])
@pytest.mark.parametrize("shape", ["sphere", "torus", "cube"])
def test_directions_that_are_none_give_what_estimated_normals_do(shape: str, kind: str) -> None:
    points, normals = clouds.CLOSED[shape](COUNT)
    found = oriented_surface(points, mistaken(kind, points, normals))
    assert found.refused
    assert found.estimated == COUNT
    estimated = oriented_surface(points, options=NormalOptions(normals="estimate"))
    np.testing.assert_array_equal(found.surface.normals, estimated.surface.normals)


@pytest.mark.parametrize("centre", [(0.0, 0, 0), (0.5, 0, 0), (0, 0, 1.0)])
def test_directions_away_from_a_centre_are_none_though_they_are_better_than_random(
    centre: tuple[float, float, float],
) -> None:
    points, normals = clouds.torus(COUNT)
    away = unit(points - np.array(centre))
    assert abs(np.einsum("nc,nc->n", away, normals)).mean() > 0.6
    assert not are_normals(points, away)
    noisy = points + 0.02 * np.random.default_rng(1).normal(size=points.shape)
    assert not are_normals(noisy, away)


@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_normals_with_errors_are_kept(shape: str) -> None:
    points, normals = clouds.CLOSED[shape](COUNT)
    random = np.random.default_rng(4)
    noise = random.normal(size=points.shape)
    off = unit(normals + np.tan(np.radians(25)) * noise)
    wrong = np.where(random.random((COUNT, 1)) < 0.3, unit(noise), normals)
    for directions in (off, wrong):
        assert are_normals(points, directions)
        assert are_normals(points + 0.02 * random.normal(size=points.shape), directions)


@pytest.mark.parametrize("noise", [0.0, 0.5, 1.5])
@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_true_normals_are_kept_however_noisy_the_points(shape: str, noise: float) -> None:
    points, normals = clouds.CLOSED[shape](COUNT)
    spacing = np.sqrt(4 * np.pi / COUNT)
    assert are_normals(points + noise * spacing * np.random.default_rng(3).normal(size=points.shape), normals)


def test_normals_of_thin_walls_and_of_lines_are_kept() -> None:
    assert are_normals(*clouds.hollow_sphere(COUNT, spacings_thick=0.5))
    angle = np.tile(np.linspace(0, 2 * np.pi, 400, endpoint=False), 20)
    pipe = np.column_stack([np.cos(angle), np.sin(angle), np.repeat(np.arange(20.0), 400)])
    assert are_normals(pipe, pipe * [1, 1, 0])


def test_the_same_however_the_cloud_is_scaled_and_without_some_directions() -> None:
    points, normals = clouds.torus(COUNT)
    some = normals * (np.random.default_rng(2).random((COUNT, 1)) < 0.3)
    assert are_normals(1e-9 * points, some)
    assert not are_normals(1e9 * points, np.random.default_rng(1).permutation(some))
    assert are_normals(points[:5], np.tile([1.0, 0.0, 0.0], (5, 1)))


def test_where_they_are_insisted_on_they_are_kept() -> None:
    points, normals = clouds.sphere(COUNT)
    directions = mistaken("labels", points, normals)
    found = oriented_surface(points, directions, NormalOptions(normals="file"))
    assert not found.refused
    assert np.allclose(abs(found.surface.normals), abs(directions))


def test_a_note_says_so() -> None:
    points, normals = clouds.sphere(COUNT)
    notes = prepare_surface(cleaned_cloud(points, mistaken("labels", points, normals))).notes
    assert notes == ("The given normals do not lie across the surface of the points: they were estimated instead.",)
