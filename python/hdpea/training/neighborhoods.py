# SPDX-License-Identifier: GPL-3.0-or-later
"""The affine map that fits psi best around each point: its gradient and what it leaves over."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from hdpea.network.layers import rows

FIT_NEIGHBORS = 16
"""Nearest points that the map is fitted to."""

RIDGE = 1e-3
"""Added to the squared tangent coordinates, in squared radii, lest neighbours on a line leave the map open."""


@dataclass
class Neighborhoods:
    """Weighted least squares in tangent coordinates, one for each of n points.

    Attributes
    ----------
    members
        (n, k) int64: the point itself, then its neighbours.
    weights
        (n, k) float32, summing to 1: what lies on another sheet has none.
    design
        (n, k, 3): 1, then the tangent coordinates in radii of the neighbourhood.
    solution
        (n, 3, k): maps values at the members to the coefficients of the map.
    radius
        (n,) float32: the largest distance to a member.
    """

    members: Tensor
    weights: Tensor
    design: Tensor
    solution: Tensor
    radius: Tensor

    @classmethod
    def of(cls, points: Tensor, normals: Tensor, neighbors: Tensor) -> Neighborhoods:
        """Prepare the fits around points (n, 3) with unit normals (n, 3) and neighbours (n, k >= 16)."""
        itself = torch.arange(len(points), device=points.device)[:, None]
        members = torch.cat([itself, neighbors[:, :FIT_NEIGHBORS]], dim=1)  # (n, k)
        way = rows(points, members) - points[:, None]  # (n, k, 3)
        radius = way.norm(dim=2).amax(dim=1).clamp_min(1e-12)  # (n,)
        cosine = (rows(normals, members) * normals[:, None]).sum(dim=2)
        weights = ((1 + cosine) / 2).clamp_min(0).square()
        weights = weights / weights.sum(dim=1, keepdim=True)  # (n, k)
        tangent = way @ tangents(normals).mT / radius[:, None, None]  # (n, k, 2)
        design = torch.cat([torch.ones_like(tangent[:, :, :1]), tangent], dim=2)  # (n, k, 3)
        weighted = (design * weights[:, :, None]).mT  # (n, 3, k)
        ridge = RIDGE * torch.eye(3, device=points.device)
        return cls(members, weights, design, torch.linalg.solve(weighted @ design + ridge, weighted), radius)

    def fit(self, psi: Tensor) -> tuple[Tensor, Tensor]:
        """Fit psi (n, c) around each point.

        Returns
        -------
        The gradient (n, 2, c) along two tangents, and the root mean square (n,) of what the map leaves over,
        in radii of the neighbourhood.
        """
        values = (rows(psi, self.members) - psi[:, None]) / self.radius[:, None, None]  # (n, k, c)
        coefficients = self.solution @ values  # (n, 3, c)
        left = values - self.design @ coefficients  # (n, k, c)
        squared = (left.square().sum(dim=2) * self.weights).sum(dim=1)
        # The root of 0 has no gradient.
        return coefficients[:, 1:], (squared + 1e-12).sqrt()


def tangents(normals: Tensor) -> Tensor:
    """Return two orthonormal tangents (n, 2, 3) at unit normals (n, 3) (Duff et al. 2017)."""
    x, y, z = normals.unbind(dim=1)
    sign = torch.where(z >= 0, 1.0, -1.0)
    a = -1 / (sign + z)
    b = x * y * a
    first = torch.stack([1 + sign * x * x * a, sign * b, -sign * x], dim=1)
    return torch.stack([first, torch.stack([b, sign + y * y * a, -y], dim=1)], dim=1)
