# SPDX-License-Identifier: GPL-3.0-or-later
"""Averages over neighbours that reproduce affine functions: the intercept of a weighted least-squares fit."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from hdpea.network.layers import rows

RIDGE = 1e-3
"""Added to the squared tangent coordinates, in squared radii: neighbours on a line do not determine a map."""


@dataclass
class Neighborhoods:
    """Weighted affine fits in tangent coordinates, one around each of n points.

    Attributes
    ----------
    members
        (n, k) int64: the point itself, then its neighbours; the point again where there are fewer.
    weights
        (n, k) float32, summing to 1: they fall with the angle between the normals, to 0 on the far side of a thin wall.
    design
        (n, k, 3): 1, then the tangent coordinates in radii of the neighbourhood.
    normal_matrix
        (n, 3, 3): of the least squares.
    radius
        (n,) float32: the largest distance to a member.
    """

    members: Tensor
    weights: Tensor
    design: Tensor
    normal_matrix: Tensor
    radius: Tensor

    @classmethod
    def of(cls, points: Tensor, normals: Tensor, neighbors: Tensor) -> Neighborhoods:
        """Prepare the fits around points (n, 3) with unit normals (n, 3) and neighbours (n, k), -1 pads."""
        itself = torch.arange(len(points), device=points.device)[:, None]
        members = torch.cat([itself, torch.where(neighbors < 0, itself, neighbors)], dim=1)  # (n, k)
        offset = rows(points, members) - points[:, None]  # (n, k, 3)
        radius = offset.norm(dim=2).amax(dim=1).clamp_min(1e-12)  # (n,)
        cosine = (rows(normals, members) * normals[:, None]).sum(dim=2)
        weights = ((1 + cosine) / 2).clamp_min(0).square()
        weights = weights / weights.sum(dim=1, keepdim=True)  # (n, k)
        tangent = offset @ tangents(normals).mT / radius[:, None, None]  # (n, k, 2)
        design = torch.cat([torch.ones_like(tangent[:, :, :1]), tangent], dim=2)  # (n, k, 3)
        normal_matrix = design.mT @ (design * weights[:, :, None])
        ridge = RIDGE * torch.eye(3, dtype=points.dtype, device=points.device)
        return cls(members, weights, design, normal_matrix + ridge, radius)

    def averaging(self) -> Tensor:
        """Return the weights (n, k) of the members in the value of the fit at the point itself."""
        unit = torch.zeros_like(self.normal_matrix[:, :, :1])
        unit[:, 0] = 1
        intercept = torch.linalg.solve(self.normal_matrix, unit)  # (n, 3, 1)
        averaging: Tensor = (self.design @ intercept)[:, :, 0] * self.weights
        return averaging / averaging.sum(dim=1, keepdim=True)

    def fit(self, psi: Tensor) -> tuple[Tensor, Tensor]:
        """Fit psi (n, c) around each point.

        Returns
        -------
        The gradient (n, 2, c) along two tangents, and the root mean square (n,) of the residual, in radii of the
        neighbourhood.
        """
        values = (rows(psi, self.members) - psi[:, None]) / self.radius[:, None, None]  # (n, k, c)
        weighted = self.design.mT @ (values * self.weights[:, :, None])  # (n, 3, c)
        coefficients = torch.linalg.solve(self.normal_matrix, weighted)
        residual = values - self.design @ coefficients  # (n, k, c)
        squared = (residual.square().sum(dim=2) * self.weights).sum(dim=1)
        # The square root has no gradient at 0.
        return coefficients[:, 1:], (squared + 1e-12).sqrt()


def averaged(values: Tensor, members: Tensor, averaging: Tensor) -> Tensor:
    """Return values (n, c) averaged over members (n, k) with weights (n, k)."""
    mean: Tensor = (averaging[:, None] @ rows(values, members))[:, 0]
    return mean


def tangents(normals: Tensor) -> Tensor:
    """Return two orthonormal tangents (n, 2, 3) at unit normals (n, 3) (Duff et al. 2017)."""
    x, y, z = normals.unbind(dim=1)
    sign = torch.where(z >= 0, 1.0, -1.0)
    a = -1 / (sign + z)
    b = x * y * a
    first = torch.stack([1 + sign * x * x * a, sign * b, -sign * x], dim=1)
    return torch.stack([first, torch.stack([b, sign + y * y * a, -y], dim=1)], dim=1)
