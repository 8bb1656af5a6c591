# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of a Point Transformer V3 block (Wu et al. 2024): convolution, attention, MLP."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional

from hdpea.network.voxels import Voxels
from hdpea.runtime.threads import fixed_order


def rows(values: Tensor, index: Tensor) -> Tensor:
    """Return values (n, c) at index (...) as (..., c); the gradient does not depend on the number of threads."""
    return functional.embedding(index, values)


def full_precision(like: Tensor) -> torch.autocast:
    """Return a context that computes in float32 even within autocast, on the device of `like`.

    Least squares, and psi itself, which is compared between neighbours, need more than the 8 bits of bfloat16.
    """
    return torch.autocast(like.device.type, enabled=False)


class Linear(nn.Linear):
    """A linear layer whose result does not depend on the number of threads."""

    def forward(self, x: Tensor) -> Tensor:
        """Map features (..., inputs) to (..., outputs)."""
        with fixed_order(x.shape[:-1].numel(), self.out_features):
            return super().forward(x)


class SparseConvolution(nn.Module):
    """A 3 x 3 x 3 convolution over the occupied voxels."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        # As torch initialises a linear layer, for the 12 or so neighbours that a voxel of a surface has.
        bound = (12 * channels) ** -0.5
        self.weight = nn.Parameter(torch.empty(27, channels, channels).uniform_(-bound, bound))

    def forward(self, x: Tensor, voxels: Voxels) -> Tensor:
        """Map features (v, c) to (v, c)."""
        sources, targets, counts = voxels.neighborhood
        moved = []
        for part, weight in zip(torch.split(rows(x, sources), counts), self.weight, strict=True):
            with fixed_order(len(part), weight.shape[1]):
                moved.append(part @ weight)
        # Under autocast products have 16 bits, which are too few for sums.
        return torch.zeros_like(x, dtype=torch.float32).index_add(0, targets, torch.cat(moved).float())


class PatchAttention(nn.Module):
    """Attention within runs of `patch_size` voxels along a curve."""

    def __init__(self, channels: int, heads: int, patch_size: int) -> None:
        super().__init__()
        self.heads, self.patch_size = heads, patch_size
        self.qkv = Linear(channels, 3 * channels)
        self.out = Linear(channels, channels)

    def forward(self, x: Tensor, voxels: Voxels, order: Tensor) -> Tensor:
        """Map features (v, c) to (v, c)."""
        members, mask, places = patches(order, voxels.counts, self.patch_size)  # (p, k), (p, k), (v,)
        shape = (*members.shape, 3, self.heads, -1)
        q, k, v = rows(self.qkv(x), members).view(shape).permute(2, 0, 3, 1, 4)  # (p, heads, k, c / heads) each
        attended = functional.scaled_dot_product_attention(q, k, v, attn_mask=mask[:, None, None])
        flat = attended.transpose(1, 2).reshape(members.numel(), -1)  # (p k, c)
        mapped: Tensor = self.out(rows(flat, places))
        return mapped


def patches(order: Tensor, counts: Tensor, size: int) -> tuple[Tensor, Tensor, Tensor]:
    """Cut the order of voxels along a curve into patches, each within one cloud.

    The last patch of a cloud overlaps the one before, so that it is as full as the others; only a cloud of fewer than
    `size` voxels is padded.

    Parameters
    ----------
    order
        (v,) int64 voxels, cloud after cloud.
    counts
        (clouds,) int64 voxels of each cloud.

    Returns
    -------
    Members (p, k) int64, which of them are real (p, k) bool, and for each voxel its place (v,) int64 in the
    flattened patches.
    """
    size = min(size, int(counts.max()))
    per_cloud = (counts + size - 1) // size
    cloud = torch.repeat_interleave(per_cloud)  # (p,)
    first = counts.cumsum(0) - counts  # (clouds,)
    number = torch.arange(len(cloud), device=order.device) - (per_cloud.cumsum(0) - per_cloud)[cloud]
    start = torch.minimum(number * size, (counts[cloud] - size).clamp_min(0))  # (p,) within its cloud
    steps = torch.arange(size, device=order.device)
    within = start[:, None] + steps  # (p, k)
    real = within < counts[cloud, None]
    position = first[cloud, None] + within.where(real, 0)
    # Where patches overlap, a voxel belongs to the one that its rank alone gives.
    rank = torch.arange(len(order), device=order.device)
    own_cloud = torch.repeat_interleave(counts)
    own_rank = rank - first[own_cloud]
    own = (per_cloud.cumsum(0) - per_cloud)[own_cloud] + own_rank // size
    places = torch.empty_like(order)
    places[order] = own * size + own_rank - start[own]
    return order[position], real, places


class Block(nn.Module):
    """Convolution (for position), attention and an MLP, each residual and with its input normalised."""

    def __init__(self, channels: int, head_width: int, patch_size: int, mlp_ratio: int) -> None:
        super().__init__()
        self.convolution = SparseConvolution(channels)
        self.position = nn.Sequential(Linear(channels, channels), nn.LayerNorm(channels))
        self.before_attention = nn.LayerNorm(channels)
        self.attention = PatchAttention(channels, channels // head_width, patch_size)
        self.mlp = nn.Sequential(
            nn.LayerNorm(channels),
            Linear(channels, mlp_ratio * channels),
            nn.GELU(),
            Linear(mlp_ratio * channels, channels),
        )

    def forward(self, x: Tensor, voxels: Voxels, order: Tensor) -> Tensor:
        """Map features (v, c) to (v, c)."""
        x = x + self.position(self.convolution(x, voxels))
        x = x + self.attention(self.before_attention(x), voxels, order)
        mapped: Tensor = x + self.mlp(x)
        return mapped
