# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals: estimated where they are missing, oriented where they disagree, kept where they are good."""

from __future__ import annotations

import numpy as np
import pytest
from helpers import clouds

from hdpea.errors import CannotReconstruct, UnreadableInput
from hdpea.options import NormalOptions
from hdpea.surface.normals import oriented_surface


def cosines(normals: clouds.Array, truth: clouds.Array) -> clouds.Array:
    return np.einsum("nc,nc->n", normals, truth)


def flipped_half(normals: clouds.Array) -> clouds.Array:
    return normals * np.random.default_rng(9).choice([-1.0, 1.0], (len(normals), 1))


def without(normals: clouds.Array, share: float) -> clouds.Array:
    """Return the normals with a random share of them made useless."""
    return normals * (np.random.default_rng(8).random((len(normals), 1)) >= share)


@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_estimated_normals_are_right_and_point_outwards(shape: str) -> None:
    points, truth = clouds.CLOSED[shape](4000)
    found = oriented_surface(points)
    agreement = cosines(found.surface.normals, truth)
    assert found.estimated == 4000
    assert found.signs is None
    assert np.median(agreement) > 0.99
    # Normals near a sharp edge may belong to either side; on a smooth surface all are right.
    assert (agreement > 0.7).mean() > (0.9 if shape in {"cube", "plate"} else 0.999)


@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_normals_that_point_both_ways_are_oriented_as_the_truth(shape: str) -> None:
    points, truth = clouds.CLOSED[shape](3000)
    found = oriented_surface(points, flipped_half(truth))
    assert found.method != "file"
    assert found.signs is not None
    assert found.signs.consistency == pytest.approx(0.5, abs=0.1)
    np.testing.assert_array_equal(found.surface.normals, truth)


@pytest.mark.parametrize("shape", ["sphere", "cube"])
def test_normals_that_all_face_along_a_positive_axis_are_oriented_as_the_truth(shape: str) -> None:
    points, truth = clouds.CLOSED[shape](10_000)
    largest = np.take_along_axis(truth, abs(truth).argmax(axis=1)[:, None], axis=1)
    found = oriented_surface(points, truth * np.sign(largest))
    assert found.signs is not None
    assert found.signs.consistency > 0.9
    assert found.method != "file"
    np.testing.assert_array_equal(found.surface.normals, truth)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_consistent_orientation_is_kept_whichever_side_it_chose(sign: int) -> None:
    points, truth = clouds.sphere(2000)
    found = oriented_surface(points, sign * truth)
    assert (found.method, found.estimated) == ("file", 0)
    np.testing.assert_array_equal(found.surface.normals, sign * truth)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("share", [0.01, 0.5])
@pytest.mark.parametrize("shape", ["sphere", "plane", "cylinder"])
def test_a_few_unusable_normals_change_nothing_about_the_others(shape: str, share: float, sign: int) -> None:
    points, truth = getattr(clouds, shape)(2000)
    given = sign * without(truth, share)
    usable = given.any(axis=1)
    found = oriented_surface(points, given)
    assert found.method == "file"
    assert found.estimated == (~usable).sum()
    np.testing.assert_array_equal(found.surface.normals[usable], given[usable])
    assert cosines(found.surface.normals, sign * truth).min() > 0.8


def test_estimating_all_ignores_the_given_ones() -> None:
    points, truth = clouds.torus(2000)
    estimate = NormalOptions(normals="estimate")
    given = oriented_surface(points, np.roll(truth, 1, axis=1), estimate)
    np.testing.assert_array_equal(given.surface.normals, oriented_surface(points).surface.normals)


def test_insisting_on_the_files_normals_fails_where_some_are_unusable() -> None:
    points, truth = clouds.sphere(500)
    insist = NormalOptions(normals="file")
    assert oriented_surface(points, truth, insist).estimated == 0
    for given in (without(truth, 0.1), None):
        with pytest.raises(UnreadableInput, match="no usable normal") as caught:
            oriented_surface(points, given, insist)
        assert "`normals='auto'`" in caught.value.hint


def test_neighbours_lie_on_the_same_sheet() -> None:
    points, truth = clouds.two_sheets(4000, 3, facing=-1)
    neighbors = oriented_surface(points, truth).surface.neighbors
    # At their rims two sheets may meet, as those of a thin plate do.
    inside = (abs(points[:, :2] - 0.5) < 0.4).all(axis=1)
    assert neighbors[:2000][inside[:2000]].max() < 2000
    second = neighbors[2000:][inside[2000:]]
    assert second[second >= 0].min() >= 2000


@pytest.mark.parametrize(
    ("points", "reason"),
    [
        (clouds.sphere(15)[0], "15 distinct points"),
        (np.linspace(0, 1, 50)[:, None] * [1.0, 2.0, 3.0], "on a line"),
        (1e7 + np.linspace(0, 0.1, 50)[:, None] * [1.0, 2.0, 3.0], "on a line"),
        (np.ones((50, 3)), "equal"),
    ],
)
def test_what_is_no_surface_is_refused(points: clouds.Array, reason: str) -> None:
    with pytest.raises(CannotReconstruct, match=reason):
        oriented_surface(points)
