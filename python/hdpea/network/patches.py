# SPDX-License-Identifier: GPL-3.0-or-later
"""Patch-based meta-embedding (PMEI; HD-PEA paper, section 3.1 and appendix H): large clouds, patch by patch.

Patches are embedded independently, so two of them differ by a rotation and a translation on the points they share.
They are aligned along the minimum spanning tree of their centres, each to all that were aligned before it, and
averaged. The affine maps of the HD-PEA paper shrink and drift along the tree; here psi is only rotated and translated,
the positions are those of the cloud, and sweeps over all patches close the loops that a tree leaves open.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core

OVERLAP = 2.0
"""Number of patches that contain a point, on average."""

SWEEPS = 2
"""Number of times that every patch is aligned again to all others."""

BORDER = 1e-3
"""Weight of a patch's outermost point; it is about 1 at the centre."""

STIFFNESS = 0.001
"""Pull towards no rotation, in squared spacings: where psi is flat, the shared points do not determine one."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Patch:
    """Points around a centre.

    Attributes
    ----------
    members
        (k,) int64, ascending.
    weights
        (k,): weight of each in an average; small at the border, where the network sees one side only.
    """

    members: NDArray[np.int64]
    weights: Array


def cut_patches(points: Array, size: int) -> tuple[NDArray[np.int64], list[Patch]]:
    """Return centres (l,) int64 and patches of `size` points that overlap and together contain all points (n, 3)."""
    wanted = int(np.ceil(OVERLAP * len(points) / size))
    centres = list(_core.farthest_point_sampling(points, wanted))
    patches = [_patch(points, centre, size) for centre in centres]
    held = np.zeros(len(points), bool)
    for each in patches:
        held[each.members] = True
    # Evenly spread centres leave gaps between their patches where points are dense.
    while not held.all():
        centres.append(np.flatnonzero(~held)[0])
        patches.append(_patch(points, centres[-1], size))
        held[patches[-1].members] = True
    return np.array(centres), patches


def _patch(points: Array, centre: int, size: int) -> Patch:
    squared = np.square(points - points[centre]).sum(axis=1)
    members = np.sort(np.argpartition(squared, size - 1)[:size]) if size < len(points) else np.arange(len(points))
    share = 1 - squared[members] / max(squared[members].max(), 1e-300)
    return Patch(members, share**2 + BORDER)


def joined_psi(points: Array, centres: NDArray[np.int64], patches: Sequence[Patch], psis: Sequence[Array]) -> Array:
    """Return one psi (n, 5) of all points.

    Parameters
    ----------
    points
        (n, 3).
    centres, patches
        As ``cut_patches`` returns them.
    psis
        Those of each patch (k, 5), in spacings.
    """
    total = _Total(np.zeros((len(points), psis[0].shape[1])), np.zeros(len(points)))
    order = spanning_order(points[centres])
    placed = {int(each): psis[each] for each in order}
    for each in order:
        placed[each] = total.aligned(patches[each], psis[each])
        total.add(patches[each], placed[each])
    for _ in range(SWEEPS):
        for each in order:
            total.add(patches[each], placed[each], -1)
            placed[each] = total.aligned(patches[each], placed[each])
            total.add(patches[each], placed[each])
    return total.sums / total.weights[:, None]


@dataclass
class _Total:
    """Weighted sums of psi (n, 5) over the patches that were added, and of their weights (n,)."""

    sums: Array
    weights: Array

    def add(self, patch: Patch, psi: Array, sign: float = 1) -> None:
        self.sums[patch.members] += sign * patch.weights[:, None] * psi
        self.weights[patch.members] += sign * patch.weights

    def aligned(self, patch: Patch, psi: Array) -> Array:
        """Return psi (k, 5) rotated and translated to fit the sums so far; unchanged if no point is shared."""
        there = self.weights[patch.members]
        shared = there > BORDER / 2
        if not shared.any():
            return psi
        weights = patch.weights[shared] * there[shared]
        target = self.sums[patch.members][shared] / there[shared, None]
        rotation, translation = isometry(psi[shared], target, weights)
        return psi @ rotation + translation


def isometry(source: Array, target: Array, weights: Array) -> tuple[Array, Array]:
    """Return the orthogonal matrix (d, d) and translation (d,) that map source (m, d) as close as possible to target.

    Weighted least squares (Kabsch 1976, reflections allowed), with a slight pull towards the identity.
    """
    share = weights / weights.sum()
    middle, wanted = share @ source, share @ target
    covariance = (source - middle).T @ (share[:, None] * (target - wanted))
    u, _, vt = np.linalg.svd(covariance + STIFFNESS * np.eye(len(covariance)))
    rotation: Array = u @ vt
    return rotation, wanted - middle @ rotation


def spanning_order(centres: Array) -> list[int]:
    """Return the order in which the minimum spanning tree of centres (l, 3) grows from the first (Prim 1957)."""
    order = [0]
    nearest = np.linalg.norm(centres - centres[0], axis=1)
    outside = np.ones(len(centres), bool)
    outside[0] = False
    while outside.any():
        following = int(np.argmin(np.where(outside, nearest, np.inf)))
        order.append(following)
        outside[following] = False
        nearest = np.minimum(nearest, np.linalg.norm(centres - centres[following], axis=1))
    return order
