# SPDX-License-Identifier: GPL-3.0-or-later
"""What a step of training sees: crops of the samples, cut by any number of loaders."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import torch
from helpers.networks import (
    QUICK,
    SPACING,
    InMemory,
    same,
    torus_sample,
)

from hdpea.training.crops import crop_number, cut_crop
from hdpea.training.joined import Joined
from hdpea.training.loaders import StepCrops, prefetched
from hdpea.training.options import CropOptions


def test_any_number_of_loaders_cuts_the_same_crops_in_the_same_order() -> None:
    crops = [list(prefetched(StepCrops(InMemory(), replace(QUICK, loaders=count), 16), 3, 6)) for count in (0, 2)]
    for first, *others in zip(*crops, strict=True):
        assert all(same(vars(first.truth), vars(each.truth)) for each in others)
        assert all(same(vars(first.clouds), vars(each.clouds)) for each in others)


def test_crops_are_functions_of_their_number_and_take_turns() -> None:
    options = replace(QUICK.crops, noisy_share=1.0, tilted_share=1.0)
    first, again = (crop_number(4, InMemory(), options, 16, 0) for _ in range(2))
    assert same(vars(first.truth), vars(again.truth))
    assert same(vars(first.clouds), vars(again.clouds))
    read: list[str] = []
    samples = InMemory()
    samples.read = lambda name: (read.append(name), torus_sample())[1]  # type: ignore[method-assign]
    for number in range(6):
        crop_number(number, samples, options, 16, 0)
    assert sorted(read[:3]) == sorted(read[3:]) == samples.names


def test_datasets_are_joined_one_after_the_other() -> None:
    first, second = InMemory(), InMemory({"0": torus_sample(100), "other": torus_sample(200)})
    joined = Joined([first, second])
    assert len(set(joined.names)) == 5
    assert [len(joined.read(name).points) for name in joined.names] == [400, 400, 400, 100, 200]


def test_crops_are_what_was_asked_for() -> None:
    options = CropOptions(least_points=100, most_points=150, margin=0.2, noisy_share=0, tilted_share=0)
    crop = cut_crop(torus_sample(1000), SPACING, options, 16, np.random.default_rng(0))
    count = len(crop.truth.points)
    assert 100 <= count <= 150
    assert crop.clouds.neighbors.shape == (count, 16)
    assert (crop.truth.weights > 0).sum() == int(0.8 * count)
    assert crop.truth.weights.sum().item() == pytest.approx(1)
    # Distances are as they were, whatever way the cloud was turned; psi's first columns turned with it.
    torch.testing.assert_close(crop.truth.psi[:, :3], 0.2 / SPACING * crop.truth.normals, rtol=0, atol=1e-5)
    torch.testing.assert_close(crop.clouds.normals, crop.truth.normals)


def test_noise_moves_what_is_seen_and_not_the_truth() -> None:
    options = CropOptions(least_points=100, most_points=150, noisy_share=1, tilted_share=1, rotations="none")
    crop = cut_crop(torus_sample(1000), SPACING, options, 16, np.random.default_rng(0))
    seen, true = (each - each.mean(dim=0) for each in (crop.clouds.points, crop.truth.points))
    assert 0 < (seen - true).norm(dim=1).mean() < 0.5
    assert 0.9 < (crop.clouds.normals * crop.truth.normals).sum(dim=1).mean() < 1


def test_a_thinned_cloud_has_the_density_asked_for() -> None:
    options = CropOptions(least_points=5000, most_points=5000, least_density=100, most_density=100)
    crop = cut_crop(torus_sample(1000), SPACING, options, 16, np.random.default_rng(0))
    assert 60 < len(crop.truth.points) < 140
