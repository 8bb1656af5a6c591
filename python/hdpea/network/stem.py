# SPDX-License-Identifier: GPL-3.0-or-later
"""The first features of points: edge convolutions, which see the change of normals, that is, curvature."""

from __future__ import annotations

import torch
from torch import Tensor, nn

from hdpea.network.layers import Linear, rows

EDGE_FEATURES = 13


def edge_features(points: Tensor, normals: Tensor, neighbors: Tensor) -> Tensor:
    """Return the features of the edge to each neighbour.

    The offset to it, the change of the normal, the normal itself; then features that are invariant to rotation: the
    length, the height of the neighbour above the tangent plane, that of the point above the neighbour's tangent plane
    (negated), and the cosine of the normals.

    Parameters
    ----------
    points, normals
        (n, 3) float32; points in units of about the distance to the 6th neighbour.
    neighbors
        (n, k) int64.

    Returns
    -------
    (n, k, 13) float32.
    """
    offset = rows(points, neighbors) - points[:, None]  # (n, k, 3)
    here, there = normals[:, None].expand_as(offset), rows(normals, neighbors)
    length = offset.norm(dim=2, keepdim=True)
    above = (offset * here).sum(dim=2, keepdim=True)
    below = (offset * there).sum(dim=2, keepdim=True)
    cosine = (here * there).sum(dim=2, keepdim=True)
    return torch.cat([offset, there - here, here, length, above, below, cosine], dim=2)


class EdgeConvolution(nn.Module):
    """Mean and maximum over the neighbours of a point of their features and those of the edges (Wang et al. 2019)."""

    def __init__(self, inputs: int, channels: int) -> None:
        super().__init__()
        self.edge = Linear(EDGE_FEATURES, channels)
        # Features of the neighbour are mapped before they are gathered to the edges: k times less work.
        self.neighbor = Linear(inputs, channels, bias=False) if inputs else None
        self.mixed = nn.Sequential(nn.GELU(), Linear(channels, channels), nn.GELU())
        self.out = nn.Sequential(Linear(2 * channels + inputs, channels), nn.LayerNorm(channels))

    def forward(self, x: Tensor | None, edges: Tensor, neighbors: Tensor) -> Tensor:
        """Map features (n, inputs), or none, and edges (n, k, 13) to (n, channels)."""
        message = self.edge(edges)  # (n, k, c)
        if self.neighbor is not None and x is not None:
            message = message + rows(self.neighbor(x), neighbors)
        message = self.mixed(message)
        gathered = [message.mean(dim=1), message.amax(dim=1)]
        mapped: Tensor = self.out(torch.cat(gathered if x is None else [*gathered, x], dim=1))
        return mapped


class EdgeStem(nn.Module):
    """Two edge convolutions on the nearest `neighbors` points."""

    def __init__(self, channels: int, neighbors: int) -> None:
        super().__init__()
        self.neighbors = neighbors
        self.first = EdgeConvolution(0, channels)
        self.second = EdgeConvolution(channels, channels)

    def forward(self, points: Tensor, normals: Tensor, neighbors: Tensor) -> Tensor:
        """Map points and normals (n, 3) with neighbours (n, k) to features (n, channels)."""
        itself = torch.arange(len(points), device=points.device)[:, None]
        nearest = neighbors[:, : self.neighbors]
        nearest = torch.where(nearest < 0, itself, nearest)
        edges = edge_features(points, normals, nearest)
        x = self.first(None, edges, nearest)
        mapped: Tensor = x + self.second(x, edges, nearest)
        return mapped
