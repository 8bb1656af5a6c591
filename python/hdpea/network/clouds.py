# SPDX-License-Identifier: GPL-3.0-or-later
"""A batch of clouds, the input of the network."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from hdpea import _core
from hdpea.geometry.tensors import symmetric_tensors, tangent_directions
from hdpea.options.embedding import CURVATURE_RADIUS

FAR = 8192.0
"""Distance from the centre, in spacings, beyond which gaps are narrowed: float32 and voxels reach little farther."""

GAP = 64.0
"""Width, in spacings, that a gap of empty space is cut down to: more than any layer sees across."""


@dataclass
class Clouds:
    """Clouds one after the other, without padding. Lengths are in spacings, sqrt(area / vertices) of the mesh to make.

    Attributes
    ----------
    points
        (n, 3) float32, relative to the centre of each cloud; clusters that are very far apart are moved together.
    normals
        (n, 3) float32, unit.
    shape
        (n, 6) float32: the shape operator (xx, yy, zz, xy, xz, yz), 1 / spacing.
    neighbors
        (n, k) int64: nearest points of the same sheet, nearest first; rows of the whole batch, -1 pads.
    batch
        (n,) int64, ascending: the cloud of each point.
    """

    points: Tensor
    normals: Tensor
    shape: Tensor
    neighbors: Tensor
    batch: Tensor

    @classmethod
    def of(
        cls,
        points: NDArray[np.float64],
        normals: NDArray[np.float64],
        neighbors: NDArray[np.int64],
        curvature_radius: float = CURVATURE_RADIUS,
    ) -> Clouds:
        """Return one cloud as a batch.

        Parameters
        ----------
        points
            (n, 3), in spacings.
        normals
            (n, 3), unit, consistently oriented.
        neighbors
            (n, k): nearest points of the same sheet, nearest first, -1 pads.
        curvature_radius
            In which the shape operator is fitted, in spacings.
        """
        centred = centred_points(points)
        return cls(
            torch.from_numpy(moved_together(centred).astype(np.float32)),
            torch.from_numpy(normals.astype(np.float32)),
            torch.from_numpy(shape_operators(centred, normals, neighbors, curvature_radius).astype(np.float32)),
            torch.from_numpy(neighbors),
            torch.zeros(len(points), dtype=torch.int64),
        )

    @classmethod
    def together(cls, clouds: Sequence[Clouds]) -> Clouds:
        """Return the clouds of several batches as one batch."""
        points = np.cumsum([0, *(len(each.points) for each in clouds)])
        first = np.cumsum([0, *(int(each.batch[-1]) + 1 for each in clouds)])
        shifted = [
            torch.where(each.neighbors < 0, each.neighbors, each.neighbors + int(start))
            for each, start in zip(clouds, points, strict=False)
        ]
        return cls(
            torch.cat([each.points for each in clouds]),
            torch.cat([each.normals for each in clouds]),
            torch.cat([each.shape for each in clouds]),
            torch.cat(shifted),
            torch.cat([each.batch + int(start) for each, start in zip(clouds, first, strict=False)]),
        )

    def to(self, device: torch.device) -> Clouds:
        """Return the batch on a device."""
        return Clouds(*(getattr(self, each.name).to(device) for each in fields(self)))


def centred_points(points: NDArray[np.floating]) -> NDArray[np.float64]:
    """Return points (n, 3) relative to the middle of their bounding box, which does not depend on their order."""
    wide = np.asarray(points, np.float64)
    lowest = wide.min(axis=0)
    return np.ascontiguousarray(wide - (lowest + (wide.max(axis=0) - lowest) / 2))


def moved_together(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points (n, 3), in spacings, with wide gaps between them narrowed where the cloud is very large.

    Clusters that are far apart for their size would lie beyond the voxels, and float32 would not resolve them. Gaps
    wider than ``GAP`` along an axis are cut down to it, which only translates the clusters. A cloud that lies within
    ``FAR`` of its centre is returned unchanged.
    """
    if not len(points) or abs(points).max() <= FAR:
        return points
    moved = np.empty_like(points)
    for axis, column in enumerate(points.T):
        order = np.argsort(column, kind="stable")
        steps = np.diff(column[order], prepend=column[order[0]])
        moved[order, axis] = np.cumsum(np.minimum(steps, GAP))
    return centred_points(moved)


def shape_operators(
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    neighbors: NDArray[np.int64],
    radius: float = CURVATURE_RADIUS,
) -> NDArray[np.float64]:
    """Return the shape operator (n, 6) of a cloud as ``Clouds.shape``, fitted within `radius` spacings."""
    curvature = _core.estimate_curvature(points, normals, neighbors, radius)
    operators = symmetric_tensors(curvature.principal, tangent_directions(normals, curvature.direction1))
    return operators[:, (0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)]
