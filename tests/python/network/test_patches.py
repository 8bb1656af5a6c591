# SPDX-License-Identifier: GPL-3.0-or-later
"""PMEI: patches hold every point, agree on a psi that they only turned, and leave the positions alone."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.networks import SPACING, TINY, neighbors_of, network_of, unit_torus

from hdpea.errors import Interrupted
from hdpea.network import inference
from hdpea.network.inference import predict_psi
from hdpea.network.patches import cut_patches, isometry, joined_psi, spanning_order


def turned(psi: np.ndarray, random: np.random.Generator) -> np.ndarray:
    return psi @ np.linalg.qr(random.standard_normal((5, 5)))[0] + random.standard_normal(5)


@pytest.mark.parametrize("uneven", [False, True])
def test_patches_hold_every_point_and_overlap(uneven: bool) -> None:
    points, _ = unit_torus(4000)
    if uneven:  # half of the points in a fiftieth of the space
        points[:2000] *= 0.02
    centres, patches = cut_patches(points, 500)
    held = np.zeros(len(points), int)
    for centre, patch in zip(centres, patches, strict=True):
        assert len(patch.members) == 500
        assert patch.weights[np.searchsorted(patch.members, centre)] == patch.weights.max()
        held[patch.members] += 1
    assert held.min() >= 1
    assert held.mean() >= 2


def test_patches_that_were_only_turned_and_shifted_are_put_back() -> None:
    points, _ = unit_torus(4000)
    random = np.random.default_rng(0)
    psi = 3 * np.sin(20 * points @ random.standard_normal((3, 5)))  # varies in all directions everywhere
    centres, patches = cut_patches(points, 500)
    joined = joined_psi(points, centres, patches, [turned(psi[each.members], random) for each in patches])
    turn, shift = isometry(joined, psi, np.ones(len(psi)))
    np.testing.assert_allclose(joined @ turn + shift, psi, atol=0.05)


def test_a_flat_psi_leaves_turns_open_and_none_is_made() -> None:
    turn, shift = isometry(np.zeros((20, 5)), np.ones((20, 5)), np.ones(20))
    np.testing.assert_allclose(turn, np.eye(5), atol=1e-12)
    np.testing.assert_allclose(shift, 1)


def test_the_spanning_tree_grows_to_the_nearest() -> None:
    assert spanning_order(np.array([[0.0, 0, 0], [5, 0, 0], [1, 0, 0], [2, 0, 0], [-4, 0, 0]])) == [0, 2, 3, 1, 4]


@pytest.fixture
def small_patches(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inference, "PATCH_POINTS", 700)


@pytest.mark.usefixtures("small_patches")
def test_in_patches_the_order_of_points_does_not_matter_to_the_last_bit() -> None:
    network, (points, normals) = network_of(TINY), unit_torus(2000)
    order = np.random.default_rng(1).permutation(len(points))

    def psi(points: np.ndarray, normals: np.ndarray) -> np.ndarray:
        return predict_psi(network, points, normals, neighbors_of(points, normals), SPACING, whole_points=1000)

    np.testing.assert_array_equal(psi(points[order], normals[order]), psi(points, normals)[order])


@pytest.mark.usefixtures("small_patches")
def test_a_cloud_in_patches_can_be_cancelled() -> None:
    points, normals = unit_torus(2000)
    with pytest.raises(Interrupted):
        predict_psi(network_of(TINY), points, normals, neighbors_of(points, normals), SPACING, 1000, lambda _: False)
