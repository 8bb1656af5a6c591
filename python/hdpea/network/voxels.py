# SPDX-License-Identifier: GPL-3.0-or-later
"""Voxels that contain points: one grid per level of the U-Net, with what attention and convolution need."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import torch
from torch import Tensor

from hdpea.network.curves import BITS, CURVES, curve_keys

MIDDLE = 1 << (BITS - 1)
"""The cell at a cloud's centre, so that no coordinate is negative."""

CELLS = 1 << BITS
"""Cells along each axis. Space is periodic beyond them: points farther from the centre share cells with nearer ones."""


@dataclass
class Voxels:
    """The occupied voxels of a batch of clouds, those of a cloud side by side.

    Attributes
    ----------
    cells
        (v, 3) int64, distinct within a cloud and sorted, so that their order does not depend on that of the points.
    batch
        (v,) int64, ascending: the cloud of each voxel.
    """

    cells: Tensor
    batch: Tensor

    @classmethod
    def holding(cls, cells: Tensor, batch: Tensor) -> tuple[Voxels, Tensor]:
        """Return the distinct voxels of `cells` (n, 3), and the voxel (n,) of each cell.

        Cells count modulo ``CELLS``, a power of two; as wide gaps are narrowed, hardly any cloud reaches so far.
        """
        keys, index = torch.unique(_packed(cells & (CELLS - 1), batch), return_inverse=True)
        axes = [(keys >> (BITS * axis)) & (CELLS - 1) for axis in (2, 1, 0)]
        return cls(torch.stack(axes, dim=1), keys >> (3 * BITS)), index

    def coarser(self) -> tuple[Voxels, Tensor]:
        """Return voxels of twice the side, and which of them (v,) contains each of these."""
        # The middle stays a corner of voxels: MIDDLE is even at every level that is ever used.
        return Voxels.holding(self.cells >> 1, self.batch)

    @cached_property
    def counts(self) -> Tensor:
        """(clouds,) int64: how many voxels each cloud has."""
        return torch.bincount(self.batch)

    @cached_property
    def orders(self) -> list[Tensor]:
        """For each of ``CURVES`` the voxels (v,) int64 in their order along it, cloud after cloud."""
        clouds = self.batch << (3 * BITS)
        return [torch.argsort(clouds | curve_keys(self.cells, curve)) for curve in CURVES]

    @cached_property
    def neighborhood(self) -> tuple[Tensor, Tensor, list[int]]:
        """Pairs of voxels that touch, themselves included, grouped by the 27 offsets from target to source.

        Returns
        -------
        Sources (pairs,), targets (pairs,) and the number of pairs for each offset.
        """
        keys = _packed(self.cells, self.batch)
        steps = torch.arange(-1, 2, device=keys.device)
        offsets = torch.cartesian_prod(steps, steps, steps)  # (27, 3)
        wanted = _packed((self.cells[None] + offsets[:, None]) & (CELLS - 1), self.batch[None])  # (27, v)
        found = torch.searchsorted(keys, wanted).clamp_max(len(keys) - 1)
        exists = keys[found] == wanted
        targets = torch.arange(len(keys), device=keys.device).expand_as(found)
        return found[exists], targets[exists], exists.sum(dim=1).tolist()


def _packed(cells: Tensor, batch: Tensor) -> Tensor:
    """Return one number per cell (..., 3) that sorts by cloud, then x, y, z."""
    x, y, z = cells.unbind(dim=-1)
    return (((batch << BITS | x) << BITS) | y) << BITS | z
