# SPDX-License-Identifier: GPL-3.0-or-later
"""psi of a cloud by a trained network and some rounds of the solver: as a whole or in patches."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray

from hdpea.errors import Interrupted
from hdpea.network.clouds import Clouds, centred_points
from hdpea.network.patches import cut_patches, joined_psi
from hdpea.network.settling import ROUNDS, settled
from hdpea.network.transformer import PointTransformer
from hdpea.options import EmbeddingOptions
from hdpea.runtime.progress import PhaseCallback

PATCH_POINTS = 30_000
"""Points of a patch."""

Array = NDArray[np.float64]


def predict_psi(
    network: PointTransformer,
    points: Array,
    normals: Array,
    neighbors: NDArray[np.int64],
    spacing: float,
    whole_points: int = EmbeddingOptions.whole_points,
    progress: PhaseCallback = lambda _: True,
    rounds: int = ROUNDS,
) -> Array:
    """Return the extra coordinates psi (n, 5) of points, in their own units.

    Points are sorted first, so that the result does not depend on their order, to the last bit.

    Parameters
    ----------
    points
        (n, 3), distinct.
    normals
        (n, 3), unit, consistently oriented.
    neighbors
        (n, k): nearest points of the same sheet, nearest first, -1 pads.
    spacing
        sqrt(area / vertices) of the mesh to make, in the unit of the points: the scale of the metric.
    whole_points
        Clouds of more points than this are embedded in patches.
    progress
        Called with the fraction done; False cancels.
    rounds
        Of the solver after the network (``settled``).

    Raises
    ------
    Interrupted
        If `progress` cancels.
    """
    centred = centred_points(points) / spacing
    order = canonical_order(centred)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    sorted_neighbors = np.ascontiguousarray(np.where(neighbors < 0, neighbors, place[neighbors])[order])
    cloud = _Cloud(centred[order], normals[order], sorted_neighbors)

    if len(points) <= whole_points:
        predicted = _embedded(network, cloud, rounds)
    else:
        predicted = _in_patches(network, cloud, rounds, progress)
    psi = np.empty(predicted.shape)
    psi[order] = predicted * spacing
    return psi


def canonical_order(points: Array) -> NDArray[np.int64]:
    """Return the order (n,) of distinct points (n, 3) by z, then y, then x."""
    return np.lexsort(points.T)


@dataclass(frozen=True)
class _Cloud:
    """Points and normals (n, 3) and neighbours (n, k), lengths in spacings."""

    points: Array
    normals: Array
    neighbors: NDArray[np.int64]

    def part(self, members: NDArray[np.int64]) -> _Cloud:
        """Return the points `members` (m,)."""
        place = np.full(len(self.points), -1)
        place[members] = np.arange(len(members))
        neighbors = self.neighbors[members]
        return _Cloud(self.points[members], self.normals[members], np.where(neighbors < 0, neighbors, place[neighbors]))


def _embedded(network: PointTransformer, cloud: _Cloud, rounds: int) -> Array:
    clouds = Clouds.of(cloud.points, cloud.normals, cloud.neighbors, network.metric.curvature_radius)
    was_training = network.training
    network.eval()
    with torch.no_grad(), _same_every_time():
        psi = network(clouds.to(next(network.parameters()).device)).cpu().numpy()
    network.train(was_training)
    return settled(cloud.points, cloud.normals, cloud.neighbors, psi.astype(np.float64), network.metric, rounds)


@contextmanager
def _same_every_time() -> Iterator[None]:
    """Let a GPU sum in the same order every time; on a CPU, torch does so anyway."""
    was, warned = torch.are_deterministic_algorithms_enabled(), torch.is_deterministic_algorithms_warn_only_enabled()
    torch.use_deterministic_algorithms(True, warn_only=True)
    try:
        yield
    finally:
        torch.use_deterministic_algorithms(was, warn_only=warned)


def _in_patches(network: PointTransformer, cloud: _Cloud, rounds: int, progress: PhaseCallback) -> Array:
    centres, patches = cut_patches(cloud.points, PATCH_POINTS)
    psis = []
    for number, patch in enumerate(patches):
        if not progress(number / len(patches)):
            raise Interrupted
        psis.append(_embedded(network, cloud.part(patch.members), rounds))
    return joined_psi(cloud.points, centres, patches, psis)
