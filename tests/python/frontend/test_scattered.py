# SPDX-License-Identifier: GPL-3.0-or-later
"""Strays that are as many as the points of the surface: dropped, and nothing of what is unevenly sampled."""

from __future__ import annotations

import numpy as np
import pytest
from helpers.clouds import sphere_points
from numpy.typing import NDArray

from hdpea.frontend.classifying import classify

Points = NDArray[np.float64]

ROUGH = 0.002


def torus(count: int) -> Points:
    """Return a torus of radii 1 and 0.4 with a little noise."""
    random = np.random.default_rng(0)
    around, along, kept = random.random((3, 3 * count)) * [[2 * np.pi], [2 * np.pi], [1.4]]
    tube = 1 + 0.4 * np.cos(along)
    places = np.stack([tube * np.cos(around), tube * np.sin(around), 0.4 * np.sin(along)], axis=1)[kept < tube]
    return np.asarray(places[:count] + random.normal(0, ROUGH, (count, 3)))


def strewn(points: Points, share: float) -> Points:
    """Return that share of a cloud of points and strays, anywhere in a box a third larger than they need."""
    low, high = points.min(axis=0), points.max(axis=0)
    margin = (high - low).max() / 6
    count = round(len(points) * share / (1 - share))
    return np.random.default_rng(1).uniform(low - margin, high + margin, (count, 3))


@pytest.mark.parametrize("share", [0.35, 0.5, 0.65])
@pytest.mark.parametrize("turned", [False, True])
def test_as_many_strays_as_points_are_dropped(share: float, turned: bool) -> None:
    points = torus(6000)
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3))).Q if turned else np.eye(3)
    cloud = np.vstack([points, strewn(points, share)]) @ turn
    strays = classify(cloud).strays
    assert not strays[:6000].any()
    assert strays[6000:].mean() > 0.7


@pytest.mark.parametrize("noise", [0.0, 0.5, 2.0])
def test_what_is_sampled_ever_more_sparsely_stays(noise: float) -> None:
    random = np.random.default_rng(3)
    sphere = sphere_points(20_000, 4)
    kept = random.random(len(sphere)) < 10 ** -(1 + sphere[:, 0])
    spacing = np.sqrt(4 * np.pi / 20_000)
    points = (sphere + noise * spacing * random.normal(size=sphere.shape))[kept]
    assert classify(points).strays.mean() < 0.02
