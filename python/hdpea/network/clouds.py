# SPDX-License-Identifier: GPL-3.0-or-later
"""A batch of clouds, one after the other, as the network reads it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from hdpea import _core
from hdpea.errors import UsageError


@dataclass
class Clouds:
    """Clouds side by side; nothing is padded.

    Attributes
    ----------
    points
        (n, 3) float32, relative to the centre of each cloud.
    normals
        (n, 3) float32, unit.
    neighbors
        (n, k) int64: nearest points in R^3, nearest first; rows of the whole batch.
    batch
        (n,) int64, ascending: the cloud of each point.
    """

    points: Tensor
    normals: Tensor
    neighbors: Tensor
    batch: Tensor

    @classmethod
    def of(
        cls, points: NDArray[np.floating], normals: NDArray[np.floating], neighbors: NDArray[np.int64] | int
    ) -> Clouds:
        """Return one cloud (n, 3) as a batch; `neighbors` (n, k) saves their search, a number asks for it."""
        centred = centred_points(points)
        if isinstance(neighbors, int):
            if neighbors >= len(points):
                raise UsageError(f"{len(points)} points are too few: the network looks at {neighbors} neighbours.")
            neighbors = _core.nearest_neighbors(centred, neighbors)
        return cls(
            torch.from_numpy(centred.astype(np.float32)),
            torch.from_numpy(np.ascontiguousarray(normals, np.float32)),
            torch.from_numpy(neighbors),
            torch.zeros(len(points), dtype=torch.int64),
        )

    @classmethod
    def together(cls, clouds: Sequence[Clouds]) -> Clouds:
        """Return the clouds of several batches as one batch."""
        points = np.cumsum([0, *(len(each.points) for each in clouds)])
        first = np.cumsum([0, *(int(each.batch[-1]) + 1 for each in clouds)])
        return cls(
            torch.cat([each.points for each in clouds]),
            torch.cat([each.normals for each in clouds]),
            torch.cat([each.neighbors + int(start) for each, start in zip(clouds, points, strict=False)]),
            torch.cat([each.batch + int(start) for each, start in zip(clouds, first, strict=False)]),
        )

    def to(self, device: torch.device) -> Clouds:
        """Return the batch on a device."""
        return Clouds(*(getattr(self, name).to(device) for name in ("points", "normals", "neighbors", "batch")))


def centred_points(points: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return points (n, 3) relative to the middle of their bounding box, which no order of them changes."""
    wide = np.asarray(points, np.float64)
    lowest = wide.min(axis=0)
    return np.ascontiguousarray(wide - (lowest + (wide.max(axis=0) - lowest) / 2))
