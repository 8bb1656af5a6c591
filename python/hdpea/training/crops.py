# SPDX-License-Identifier: GPL-3.0-or-later
"""Crops of clouds, each a function of the dataset, the seed and its number only: training can resume at any step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import torch
from numpy.typing import NDArray

from hdpea import _core
from hdpea.dataset.augmentation import TRANSFORMS, random_rotation
from hdpea.dataset.sample import Sample
from hdpea.geometry.metric import ScaledMetric
from hdpea.network.clouds import Clouds
from hdpea.training.losses import Truth
from hdpea.training.options import CropOptions

ORDER, CROP = 0, 1
"""Purposes of the streams of random numbers."""


class Samples(Protocol):
    """The interface of a dataset to train on."""

    @property
    def names(self) -> Sequence[str]:
        """The names of the samples, in a fixed order."""

    @property
    def metric(self) -> ScaledMetric:
        """The metric of their ground truth, in spacings."""

    def read(self, name: str) -> Sample:
        """Read a sample."""

    def spacing(self, name: str) -> float:
        """Return the unit of the lengths of its ground truth, in unit length."""


@dataclass
class Crop:
    """A part of a cloud, n points, as input of the network, with its ground truth."""

    clouds: Clouds
    truth: Truth

    @classmethod
    def together(cls, crops: Sequence[Crop]) -> Crop:
        """Join crops into one batch; each has the same total weight, however many points it has."""
        if len(crops) == 1:
            return crops[0]
        clouds = Clouds.together([each.clouds for each in crops])
        joined = {
            name: torch.cat([getattr(each.truth, name) for each in crops])
            for name in ("points", "normals", "psi", "weights")
        }
        joined["weights"] /= len(crops)
        starts = np.cumsum([0, *(len(each.truth.points) for each in crops)])
        neighbors = [each.truth.neighbors + int(start) for each, start in zip(crops, starts, strict=False)]
        return cls(clouds, Truth(neighbors=torch.cat(neighbors), **joined))

    def to(self, device: torch.device) -> Crop:
        """Return the crop on a device."""
        return Crop(self.clouds.to(device), self.truth.to(device))


def crop_number(number: int, samples: Samples, options: CropOptions, neighbors: int, seed: int) -> Crop:
    """Return crop `number`: each epoch takes every sample once, in an order of its own."""
    epoch, place = divmod(number, len(samples.names))
    order = np.random.default_rng((seed, ORDER, epoch)).permutation(len(samples.names))
    name = samples.names[order[place]]
    random = np.random.default_rng((seed, CROP, number))
    return cut_crop(samples.read(name), samples.spacing(name), options, neighbors, random)


def cut_crop(sample: Sample, spacing: float, options: CropOptions, neighbors: int, random: np.random.Generator) -> Crop:
    """Cut a part of a sample, thin, rotate and perturb it, in spacings; each point gets its nearest `neighbors`."""
    count = len(sample.points)
    size = int(random.integers(options.least_points, options.most_points, endpoint=True))
    density = random.integers(options.least_density, options.most_density, endpoint=True)
    kept = np.flatnonzero(random.random(count) < density / count) if density < count else np.arange(count)
    apart = sample.points[kept] - sample.points[random.choice(kept)]
    distances = np.einsum("ni,ni->n", apart, apart)
    whole = size >= len(kept)
    # In the order of the sample: where neighbours are side by side in memory, they are found faster.
    nearest = np.arange(len(kept)) if whole else np.sort(np.argpartition(distances, size - 1)[:size])
    chosen = kept[nearest]
    judged = len(chosen) if whole else max(int(len(chosen) * (1 - options.margin)), 1)
    inner = distances[nearest] <= np.partition(distances[nearest], judged - 1)[judged - 1]

    matrix = _orthogonal(options.rotations, random)
    surface_points, points = (each[chosen] @ matrix.T / spacing for each in (sample.surface_points, sample.points))
    true_normals = sample.normals[chosen] @ matrix.T
    normals = true_normals
    if sample.estimated_normals is not None and random.random() < options.estimated_share:
        normals = sample.estimated_normals[chosen] @ matrix.T
    if random.random() < options.noisy_share and np.array_equal(points, surface_points):
        points = points + options.noise * random.random() ** 2 * random.standard_normal(points.shape)
    if random.random() < options.tilted_share:
        normals = normals + options.tilt * random.random() ** 2 * random.standard_normal(normals.shape)
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    # The first three columns of psi start as the normal in the solver, so they rotate with the cloud.
    psi = np.hstack([sample.psi[chosen, :3] @ matrix.T, sample.psi[chosen, 3:]]) / spacing

    around = _core.nearest_neighbors(points, min(neighbors, len(chosen) - 1))
    clouds = Clouds.of(points, normals, _core.sheet_neighbors(points, normals, around))
    weights = torch.from_numpy(inner.astype(np.float32) / np.float32(inner.sum()))
    truth = Truth(_tensor(surface_points), _tensor(true_normals), _tensor(psi), torch.from_numpy(around), weights)
    return Crop(clouds, truth)


def _tensor(array: NDArray[np.floating]) -> torch.Tensor:
    return torch.from_numpy(np.ascontiguousarray(array, np.float32))


def _orthogonal(kind: str, random: np.random.Generator) -> NDArray[np.float64]:
    """Return a random orthogonal matrix (3, 3): any, one of the ten of HD-PEA, or the identity."""
    if kind == "any":
        # The negative of a rotation is a reflection.
        return random_rotation(random) * float(random.choice([-1.0, 1.0]))
    ten = list(TRANSFORMS.values())
    return ten[random.integers(len(ten))] if kind == "ten" else TRANSFORMS["identity"]
