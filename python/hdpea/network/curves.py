# SPDX-License-Identifier: GPL-3.0-or-later
"""Space-filling curves: voxels in an order in which neighbours in the list are neighbours in space."""

from __future__ import annotations

import torch
from torch import Tensor

BITS = 16
"""Bits of a voxel's coordinate, 0 to 65,535 on each axis: with three axes, 15 bits of a key remain for the cloud."""

CURVES = ("z", "z_transposed", "hilbert", "hilbert_transposed")


def curve_keys(cells: Tensor, curve: str) -> Tensor:
    """Return the position of each cell along a curve, distinct for distinct cells.

    Parameters
    ----------
    cells
        (n, 3) int64, 0 to 2^16 - 1.
    curve
        One of ``CURVES``; the transposed ones have x and y exchanged, so that they cut space in other places.

    Returns
    -------
    (n,) int64, below 2^48.
    """
    if curve.endswith("_transposed"):
        cells = cells[:, [1, 0, 2]]
    return _interleaved(_hilbert(cells) if curve.startswith("hilbert") else cells)


def _interleaved(cells: Tensor) -> Tensor:
    """Return the bits x15 y15 z15 x14 ... z0 of cells (n, 3) as one number (n,)."""
    spread = cells
    # Each step doubles the gaps between groups of bits, until two zeros follow every bit.
    for shift, mask in ((16, 0xFF0000FF), (8, 0xF00F00F00F), (4, 0xC30C30C30C3), (2, 0x249249249249)):
        spread = (spread | (spread << shift)) & mask
    return (spread[:, 0] << 2) | (spread[:, 1] << 1) | spread[:, 2]


def _hilbert(cells: Tensor) -> Tensor:
    """Return the transpose form of the Hilbert index of cells (n, 3) (Skilling 2004, AxestoTranspose)."""
    x = list(cells.unbind(dim=1))
    for bit in range(BITS - 1, 0, -1):
        below = (1 << bit) - 1
        for axis in range(3):
            # Where the bit is set, invert the lower bits of x; elsewhere exchange them with this axis's.
            is_set = -((x[axis] >> bit) & 1)
            exchanged = (x[0] ^ x[axis]) & below & ~is_set
            x[0] = x[0] ^ exchanged ^ (below & is_set)
            if axis:
                x[axis] = x[axis] ^ exchanged
    x[1] = x[1] ^ x[0]
    x[2] = x[2] ^ x[1]
    turned = torch.zeros_like(x[0])
    for bit in range(BITS - 1, 0, -1):
        turned = turned ^ (-((x[2] >> bit) & 1) & ((1 << bit) - 1))
    return torch.stack([each ^ turned for each in x], dim=1)
