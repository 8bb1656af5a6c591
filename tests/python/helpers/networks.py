# SPDX-License-Identifier: GPL-3.0-or-later
"""A network small enough for tests, and what it is trained on."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
import torch
from helpers.clouds import torus
from helpers.samples import sphere_sample

from hdpea import _core
from hdpea.dataset.sample import Sample
from hdpea.geometry.metric import ScaledMetric
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.network.clouds import Clouds
from hdpea.network.inference import predict_psi
from hdpea.network.options import NetworkOptions
from hdpea.network.transformer import PointTransformer
from hdpea.network.weights import UNRECORDED_METRIC
from hdpea.training.options import CropOptions, TrainingOptions

TINY = NetworkOptions(
    channels=(16, 32),
    depths=(2, 1),
    decoder_channels=(16,),
    decoder_depths=(1,),
    head_width=8,
    patch_size=32,
    voxel=0.5,
    neighbors=8,
    stem=True,
    stem_channels=8,
    normal_share=2.0,
)

METRIC = UNRECORDED_METRIC

SPACING = 0.1
"""Of the vertices of a mesh of the tori here."""

QUICK = TrainingOptions(
    steps=10, warm_up=3, batch=2, log_every=2, validate_every=100, crops=CropOptions(least_points=100, most_points=150)
)


def network_of(options: NetworkOptions = TINY, metric: ScaledMetric = METRIC) -> PointTransformer:
    return PointTransformer(options, metric)


def torus_sample(count: int = 400, seed: int = 0) -> Sample:
    """A torus of diagonal 1 with psi = 0.2 n, and 0.1 p in the last columns."""
    points, normals = torus(count, seed=seed)
    scale = np.linalg.norm(np.ptp(points, axis=0))
    sample = sphere_sample(count)
    points = np.float32(points / scale)
    return replace(
        sample,
        points=points,
        surface_points=points,
        normals=np.float32(normals),
        psi=np.float32(np.hstack([0.2 * normals, 0.1 * points[:, :2]])),
        frame=UnitFrame(np.zeros(3), float(scale)),
    )


def unit_torus(count: int = 500, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    points, normals = torus(count, seed=seed)
    return points / np.linalg.norm(np.ptp(points, axis=0)), normals


def neighbors_of(points: np.ndarray, normals: np.ndarray) -> np.ndarray:
    return _core.sheet_neighbors(points, normals, _core.nearest_neighbors(points, 16))


def cloud_of(points: np.ndarray, normals: np.ndarray) -> Clouds:
    return Clouds.of(points / SPACING, normals, neighbors_of(points, normals))


def predicted(
    network: PointTransformer, points: np.ndarray, normals: np.ndarray, spacing: float = SPACING
) -> np.ndarray:
    return predict_psi(network, points, normals, neighbors_of(points, normals), spacing)


@dataclass
class InMemory:
    """A dataset without files."""

    data: dict[str, Sample] = field(default_factory=lambda: {str(seed): torus_sample(seed=seed) for seed in range(3)})
    metric: ScaledMetric = METRIC

    @property
    def names(self) -> list[str]:
        return list(self.data)

    def read(self, name: str) -> Sample:
        return self.data[name]

    def spacing(self, _name: str) -> float:
        return SPACING


def same(first: object, second: object) -> bool:
    """Whether nested containers hold the same tensors to the last bit."""
    if isinstance(first, torch.Tensor) and isinstance(second, torch.Tensor):
        return torch.equal(first, second)
    if isinstance(first, dict) and isinstance(second, dict):
        return first.keys() == second.keys() and all(same(first[key], second[key]) for key in first)
    if isinstance(first, list | tuple) and isinstance(second, list | tuple):
        return len(first) == len(second) and all(map(same, first, second))
    return first == second
