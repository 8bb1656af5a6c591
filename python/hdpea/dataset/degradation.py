# SPDX-License-Identifier: GPL-3.0-or-later
"""Degradation of samples: noise, outliers, uneven density, missing parts, wrong normals; the functions compose.

Functions that change the points drop the estimated normals, which belong to other points: estimate them again
afterwards. Functions that remove points leave fewer: sample more first where a certain number is needed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.augmentation import random_rotation
from hdpea.dataset.options import DegradationOptions
from hdpea.dataset.outliers import draw_outliers
from hdpea.dataset.sample import Sample
from hdpea.errors import UsageError

SPARSE = 0.1
"""Share of the points that are kept where the density is lowest."""

STRIPES = 8
"""Number of stripes along the longest axis, alternately dense and sparse."""


def degraded(sample: Sample, options: DegradationOptions) -> Sample:
    """Apply all degradations that the options ask for: first those that remove points, then those that move them.

    Each has a random stream of its own, so adding one degradation does not change the random numbers of another.

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
    for wanted, step in steps:
        sample = step(sample) if wanted else sample
    return sample


def clipped(sample: Sample, rng: np.random.Generator) -> Sample:
    """Keep the points on one side of a randomly oriented plane through their mean."""
    direction = random_rotation(rng)[0]
    height = sample.surface_points @ direction
    return _kept(sample, height >= height.mean())


def with_missing(sample: Sample, count: int, radius: float, rng: np.random.Generator) -> Sample:
    """Keep the points outside `count` balls around random points of the surface."""
    kept = np.ones(len(sample.points), dtype=np.bool_)
    for centre in sample.surface_points[rng.integers(len(kept), size=count)]:
        kept &= np.linalg.norm(sample.surface_points - centre, axis=1) > radius
    return _kept(sample, kept)


def thinned(sample: Sample, density: str, rng: np.random.Generator) -> Sample:
    """Thin the points unevenly along the longest axis, after PCPNet (Guerrero et al., 2018), with our own strength.

    ``gradient``: the share that is kept falls linearly from 1 at one end to ``SPARSE`` at the other. ``striped``: it
    is alternately 1 and ``SPARSE``, in stripes of equal width.
    """
    share = _along_longest_axis(sample.surface_points)
    if density == "gradient":
        share_kept = 1 - (1 - SPARSE) * share
    else:
        stripe = np.minimum(share * STRIPES, STRIPES - 1).astype(np.int64)  # the far end belongs to the last stripe
        share_kept = np.where(stripe % 2 == 0, 1.0, SPARSE)
    return _kept(sample, rng.random(len(share)) < share_kept)


def with_noise(sample: Sample, std: float, rng: np.random.Generator) -> Sample:
    """Add Gaussian noise to each coordinate of the points; its std is a share of the bounding-box diagonal."""
    noise = std * rng.standard_normal(sample.points.shape)
    return replace(sample, points=(sample.points + noise).astype(np.float32), estimated_normals=None)


def with_outliers(sample: Sample, share: float, rng: np.random.Generator) -> Sample:
    """Move a share of the points to random places in a box around all of them.

    The truth of an outlier is that of the point of the surface nearest to it; its sensor is kept. Only its distance
    from the surface marks it as an outlier.
    """
    outliers = draw_outliers(sample.points, sample.surface_points, share, rng)
    truth = np.arange(len(sample.points))
    truth[outliers.rows] = outliers.nearest
    points = sample.points.copy()
    points[outliers.rows] = outliers.places
    return replace(_at(sample, truth), points=points, sensors=sample.sensors)


def with_normal_noise(sample: Sample, std: float, rng: np.random.Generator) -> Sample:
    """Add Gaussian noise to each component of the normals that a method is given, and normalise them again.

    These are the estimated normals, or a copy of the true ones where there are none; the truth itself is kept.
    """
    given = _given_normals(sample)
    noisy = given + std * rng.standard_normal(given.shape)
    noisy /= np.linalg.norm(noisy, axis=1, keepdims=True)
    return replace(sample, estimated_normals=noisy.astype(np.float32))


def with_flipped_normals(sample: Sample, share: float, rng: np.random.Generator) -> Sample:
    """Reverse a share of the normals that a method is given; the truth itself is kept."""
    given = _given_normals(sample)
    reversed_rows = rng.choice(len(given), round(share * len(given)), replace=False)
    flipped = given.copy()
    flipped[reversed_rows] *= -1
    return replace(sample, estimated_normals=flipped)


def _given_normals(sample: Sample) -> NDArray[np.float32]:
    return sample.normals if sample.estimated_normals is None else sample.estimated_normals


def _along_longest_axis(points: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the position of points along the longest side of their box, from 0 to 1; 0 if all are equal."""
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
