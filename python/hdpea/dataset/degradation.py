# SPDX-License-Identifier: GPL-3.0-or-later
"""Samples made worse: noise, outliers, uneven density, missing parts, wrong normals; the functions compose.

What changes the points drops their estimated normals, which were estimated from other points: estimate anew
afterwards. What removes points leaves fewer of them: where a number is wanted, sample more first.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.dataset.augmentation import random_rotation
from hdpea.dataset.options import DegradationOptions
from hdpea.dataset.sample import Sample
from hdpea.errors import UsageError, core_errors_translated

SPARSE = 0.1
"""Share of the points that stays where a density is lowest."""

STRIPES = 8
"""Stripes along the longest axis, dense and sparse in turn."""

OUTLIER_BOX = 1.2
"""Size of the box in which outliers lie, in that of the points."""


def degraded(sample: Sample, options: DegradationOptions) -> Sample:
    """Return the sample with all that the options name done to it: first what removes points, then what moves them.

    Each draws from a stream of its own, so adding one degradation does not change what another one draws.

    Raises
    ------
    UsageError
        If no points are left.
    """
    clips, cuts, thins, moves, strays, tilts, flips = np.random.default_rng(options.seed).spawn(7)
    steps: list[tuple[object, Callable[[Sample], Sample]]] = [
        (options.clipped, lambda given: clipped(given, clips)),
        (options.missing, lambda given: with_missing(given, options.missing, options.missing_radius, cuts)),
        (options.density != "even", lambda given: thinned(given, options.density, thins)),
        (options.noise, lambda given: with_noise(given, options.noise, moves)),
        (options.outliers, lambda given: with_outliers(given, options.outliers, strays)),
        (options.normal_noise, lambda given: with_normal_noise(given, options.normal_noise, tilts)),
        (options.flipped, lambda given: with_flipped_normals(given, options.flipped, flips)),
    ]
    for asked, step in steps:
        sample = step(sample) if asked else sample
    return sample


def clipped(sample: Sample, rng: np.random.Generator) -> Sample:
    """Return the points on one side of a plane through their mean, of a random direction."""
    direction = random_rotation(rng)[0]
    height = sample.surface_points @ direction
    return _kept(sample, height >= height.mean())


def with_missing(sample: Sample, count: int, radius: float, rng: np.random.Generator) -> Sample:
    """Return the points outside `count` balls around random points of the surface."""
    kept = np.ones(len(sample.points), dtype=np.bool_)
    for centre in sample.surface_points[rng.integers(len(kept), size=count)]:
        kept &= np.linalg.norm(sample.surface_points - centre, axis=1) > radius
    return _kept(sample, kept)


def thinned(sample: Sample, density: str, rng: np.random.Generator) -> Sample:
    """Return points unevenly dense along the longest axis, after PCPNet (Guerrero et al., 2018); its strength is ours.

    ``gradient``: the share that stays falls linearly from 1 at one end to ``SPARSE`` at the other. ``striped``: it is
    1 and ``SPARSE`` in turn, in stripes of the same width.
    """
    share = _along_longest_axis(sample.surface_points)
    if density == "gradient":
        stays = 1 - (1 - SPARSE) * share
    else:
        stripe = np.minimum(share * STRIPES, STRIPES - 1).astype(np.int64)  # the far end belongs to the last one
        stays = np.where(stripe % 2 == 0, 1.0, SPARSE)
    return _kept(sample, rng.random(len(share)) < stays)


def with_noise(sample: Sample, std: float, rng: np.random.Generator) -> Sample:
    """Return the points with Gaussian noise on each coordinate, its std a share of the bounding-box diagonal."""
    noise = std * rng.standard_normal(sample.points.shape)
    return replace(sample, points=(sample.points + noise).astype(np.float32), estimated_normals=None)


def with_outliers(sample: Sample, share: float, rng: np.random.Generator) -> Sample:
    """Return the sample with a share of its points moved to anywhere in a box around all of them.

    An outlier stands for the point of the surface nearest to it, and has the truth of that; its sensor stays. Nothing
    but its distance from there marks it.
    """
    count = len(sample.points)
    chosen = rng.choice(count, round(share * count), replace=False)
    lowest, highest = sample.points.min(axis=0), sample.points.max(axis=0)
    anywhere = (lowest + highest) / 2 + OUTLIER_BOX * (highest - lowest) * (rng.random((len(chosen), 3)) - 0.5)
    truth = np.arange(count)
    on_surface = sample.surface_points.astype(np.float64)
    with core_errors_translated():
        truth[chosen] = _core.nearest_neighbors(on_surface, anywhere.astype(np.float64), 1)[:, 0]
    points = sample.points.copy()
    points[chosen] = anywhere
    return replace(_at(sample, truth), points=points, sensors=sample.sensors)


def with_normal_noise(sample: Sample, std: float, rng: np.random.Generator) -> Sample:
    """Return the sample with Gaussian noise on each component of the normals that a method is given, renormalised.

    These are the estimated normals, or a copy of the true ones where there are none; the truth itself stays.
    """
    given = _given_normals(sample)
    noisy = given + std * rng.standard_normal(given.shape)
    noisy /= np.linalg.norm(noisy, axis=1, keepdims=True)
    return replace(sample, estimated_normals=noisy.astype(np.float32))


def with_flipped_normals(sample: Sample, share: float, rng: np.random.Generator) -> Sample:
    """Return the sample with a share of the normals that a method is given turned round; the truth itself stays."""
    given = _given_normals(sample)
    turned = rng.choice(len(given), round(share * len(given)), replace=False)
    flipped = given.copy()
    flipped[turned] *= -1
    return replace(sample, estimated_normals=flipped)


def _given_normals(sample: Sample) -> NDArray[np.float32]:
    return sample.normals if sample.estimated_normals is None else sample.estimated_normals


def _along_longest_axis(points: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return where points lie along the longest side of their box, from 0 to 1; 0 if they are all equal."""
    extent = np.ptp(points, axis=0)
    along = points[:, np.argmax(extent)].astype(np.float64)
    share: NDArray[np.float64] = (along - along.min()) / (extent.max() or 1)
    return np.minimum(share, 1)


def _kept(sample: Sample, kept: NDArray[np.bool_]) -> Sample:
    if not kept.any():
        raise UsageError("The degradation leaves no points.", "Remove less, or sample more points first.")
    return _at(sample, np.flatnonzero(kept))


def _at(sample: Sample, rows: NDArray[np.int64]) -> Sample:
    columns: dict[str, Any] = {each.name: getattr(sample, each.name) for each in fields(sample)}
    taken = {name: column[rows] for name, column in columns.items() if isinstance(column, np.ndarray)}
    return Sample(**{**columns, **taken, "estimated_normals": None})
