# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side is out: every way of saying so, and what each cannot do without."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from helpers import clouds

from hdpea import _core
from hdpea.errors import UnreadableInput, UsageError
from hdpea.options import NormalOptions
from hdpea.options.position import Position
from hdpea.surface import agreement_of_signs
from hdpea.surface.normals import OrientedSurface, oriented_surface
from hdpea.surface.signs import cosines

Array = clouds.Array


def oriented(points: Array, given: Array | None = None, sensors: Array | None = None, **chosen: Any) -> Array:
    return oriented_surface(points, given, NormalOptions(**chosen), sensors_in_world=sensors).surface.normals


def chosen_way(found: OrientedSurface) -> list[float | int | str]:
    return [choice.value for choice in found.choices if choice.name == "orient"]


def flipped_half(normals: Array) -> Array:
    return normals * np.random.default_rng(9).choice([-1.0, 1.0], (len(normals), 1))


@pytest.mark.parametrize("way", ["wnnc", "mst"])
@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_normals_are_oriented_outwards_whatever_their_signs(shape: str, way: str) -> None:
    points, truth = clouds.CLOSED[shape](3000)
    found = oriented(points, flipped_half(truth), orient=way)
    assert (cosines(found, truth) > 0).mean() > 0.995
    np.testing.assert_array_equal(found, oriented(points, truth, orient=way))


def test_the_winding_number_stands_the_noise_that_a_spanning_tree_does_not() -> None:
    points, truth = clouds.box(6000, (1, 1, 0.1))
    points = points + np.random.default_rng(3).normal(0, 0.01, points.shape)
    right = {way: (cosines(oriented(points, orient=way), truth) > 0).mean() for way in ("wnnc", "mst")}
    assert right["wnnc"] > 0.97 > right["mst"]


def test_the_thicker_the_noise_the_wider_the_winding_number() -> None:
    points, truth = clouds.sphere(4000)
    spacing = np.sqrt(4 * np.pi / 4000)
    thick = points + np.random.default_rng(3).normal(0, 1.5 * spacing, points.shape)
    assert (cosines(oriented(thick), truth) > 0).mean() > 0.99


@pytest.mark.parametrize("noise", [0, 0.05])
def test_the_sides_of_a_wall_thinner_than_the_spacing_are_told_apart(noise: float) -> None:
    spacing = np.sqrt(2 / 6000)
    points, truth = clouds.box(6000, (1, 1, 0.7 * spacing))
    points = points + np.random.default_rng(3).normal(0, noise * spacing, points.shape)
    assert (cosines(oriented(points), truth) > 0).mean() > 0.96


@pytest.mark.parametrize("shape", clouds.CLOSED)
def test_some_points_decide_the_side_of_all(shape: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(agreement_of_signs, "DECIDING", 1500)
    points, truth = clouds.CLOSED[shape](6000)
    assert (cosines(oriented(points, flipped_half(truth)), truth) > 0).mean() > 0.995


@pytest.mark.parametrize("sign", [1, -1])
def test_the_signs_of_the_file_are_taken_as_they_are(sign: int) -> None:
    points, truth = clouds.torus(2000)
    both_ways = sign * flipped_half(truth)
    np.testing.assert_array_equal(oriented(points, both_ways, orient="file"), both_ways)


def test_estimated_normals_can_have_the_signs_of_the_file() -> None:
    points, truth = clouds.sphere(2000)
    both_ways = flipped_half(truth)
    found = oriented(points, both_ways, orient="file", normals="estimate")
    assert not np.array_equal(found, both_ways)
    assert cosines(found, both_ways).min() > 0.9


def test_signs_that_the_file_lacks_are_unreadable() -> None:
    points, truth = clouds.sphere(500)
    for given in (None, 0 * truth):
        with pytest.raises(UnreadableInput, match="no usable normals") as caught:
            oriented(points, given, orient="file")
        assert "`orient='auto'`" in caught.value.hint


def test_normals_face_the_viewpoint() -> None:
    points, truth = clouds.plane(1000)
    above, below = (oriented(1000 + points, orient="viewpoint", viewpoint=Position(1000, 1000, z)) for z in (2000, 900))
    np.testing.assert_allclose(above, truth, atol=1e-9)
    np.testing.assert_array_equal(above, -below)


def test_normals_face_each_its_own_sensor_unless_a_viewpoint_is_given() -> None:
    points, truth = clouds.sphere(1000)
    inside = oriented(points, flipped_half(truth), 0 * points, orient="viewpoint")
    np.testing.assert_array_equal(inside, -truth)
    outside = oriented(points, flipped_half(truth), 3 * points, orient="viewpoint")
    np.testing.assert_array_equal(outside, truth)
    origin = Position(0, 0, 0)
    np.testing.assert_array_equal(oriented(points, truth, 3 * points, orient="viewpoint", viewpoint=origin), inside)


def test_what_a_viewpoint_needs_is_said() -> None:
    points, truth = clouds.sphere(500)
    with pytest.raises(UsageError, match="no viewpoint") as caught:
        oriented(points, truth, orient="viewpoint")
    assert "sensor_x" in caught.value.hint
    with pytest.raises(UnreadableInput, match="sensor position"):
        oriented(points, truth, np.full_like(points, np.nan), orient="viewpoint")
    with pytest.raises(UsageError, match="of no use with orient auto"):
        NormalOptions(viewpoint=Position(0, 0, 0))


def test_sensors_at_absurd_distances_are_unreadable_where_they_matter() -> None:
    points, truth = clouds.sphere(500)
    far = 1e300 * truth
    with pytest.raises(UnreadableInput, match="too far from the points"):
        oriented(1e-20 * points, truth, far, orient="viewpoint")
    np.testing.assert_array_equal(oriented(1e-20 * points, truth, far), truth)


def test_more_neighbours_than_points_are_all_points() -> None:
    points, _ = clouds.sphere(100)
    every, more = (oriented(points, normal_neighbors=count) for count in (100, 2**31 - 1))
    np.testing.assert_array_equal(every, more)


def test_what_was_chosen_is_told() -> None:
    points, truth = clouds.torus(2000)
    assert chosen_way(oriented_surface(points, truth)) == ["file"]
    assert chosen_way(oriented_surface(points, flipped_half(truth))) == ["wnnc"]
    assert chosen_way(oriented_surface(points)) == ["wnnc"]
    assert chosen_way(oriented_surface(clouds.plane(1000)[0])) == ["viewpoint"]
    assert chosen_way(oriented_surface(points, truth, NormalOptions(orient="wnnc"))) == []


@pytest.mark.parametrize("text", ["1,2", "a,b,c", "1,2,nan", "", "1 2 3"])
def test_what_is_no_position_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match="position"):
        Position.parse(text)


def test_positions_are_read_as_they_are_written() -> None:
    position = Position.parse("1, -2.5,3e7")
    assert position == Position(1, -2.5, 3e7)
    assert Position.parse(str(position)) == position


def test_neighbors_outvote_a_winding_number_that_is_wrong_about_a_part(monkeypatch: pytest.MonkeyPatch) -> None:
    points, truth = clouds.torus(4000)
    wrong = truth * np.where(points[:, :1] > 0.5, -1, 1)
    monkeypatch.setattr(_core, "wnnc_normals", lambda *_: wrong)
    assert (cosines(oriented(points), truth) > 0).mean() > 0.999


def test_the_winding_number_decides_between_parts_that_nothing_joins(monkeypatch: pytest.MonkeyPatch) -> None:
    one, other = clouds.torus(3000), clouds.sphere(2000)
    points, truth = np.vstack([one[0], other[0] + [9, 0, 0]]), np.vstack([one[1], -other[1]])
    # Some are wrong everywhere, and most are right.
    votes = truth * np.where(np.random.default_rng(0).random((5000, 1)) < 0.3, -1, 1)
    monkeypatch.setattr(_core, "wnnc_normals", lambda *_: votes)
    assert (cosines(oriented(points), truth) > 0).mean() > 0.999
