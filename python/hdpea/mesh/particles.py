# SPDX-License-Identifier: GPL-3.0-or-later
"""Particles that spread evenly over the embedded surface: the future vertices."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.spatial_order import spatial_order
from hdpea.mesh.cells import restricted_cells
from hdpea.options import EmbeddingOptions, ParticleOptions
from hdpea.options.particles import ITERATIONS
from hdpea.runtime.progress import PhaseCallback
from hdpea.runtime.pytorch import torch_device

if TYPE_CHECKING:
    import torch

KERNEL_WIDTH = 0.28
"""sigma in units of sqrt(area / particles). HD-PEA (section B) takes 0.32; a slightly narrower kernel orders better."""

AREA_DISK_RADIUS = 2.0
"""Radius of the disks that measure the area, in mean distances of the seeds: large enough to hold their cells."""

MOST_AREA = 16.0
"""Most that a seed's cell counts for, in medians: even ones have no larger disks.

That of a thing so small that one seed is all of it reaches to the next thing: sixty points, thirty diagonals away, made
the particles of all others leave their places. Flying pixels have some hundreds, too."""

INTERACTIONS = 16
"""Particles that push each particle; the kernel is negligible beyond."""

REFRESH = 5
"""Steps after which these neighbours are searched for again."""

MOMENTUM = 0.8
"""Share of each step that is added to the next one (heavy ball): worth three times the iterations without."""

STEP, DECAY, DECAY_EVERY = 0.5, 0.8, 20
"""First step in units of sigma^2 times the force, and its decay (HD-PEA, section E, without momentum: 0.6).

Twice that step orders the particles equally well with momentum, but amplifies a difference of 1e-13 in the embedding
700 times in 100 steps, this one 150 times."""

STRIDES = 12
"""Neighbours among which a particle's nearest cloud point is followed from step to step."""

AT_ONCE = 2_000
"""Rows that the processor works on at a time, so few that what is worked out of them stays in its caches: of 83,000
particles a step takes half of the time. A graphics processor takes all at once."""


@dataclass(frozen=True)
class Particles:
    """Evenly spread points of the embedded surface.

    Attributes
    ----------
    coordinates
        (m, d) float64; the first three columns are positions in the unit frame.
    nearest
        (m,) int64: the cloud point in whose tangent plane each particle lies.
    """

    coordinates: NDArray[np.float64]
    nearest: NDArray[np.int64]


class _Cloud:
    """The embedded surface in torch: points, tangent planes, and steps to neighbours."""

    def __init__(
        self,
        coordinates: NDArray[np.float64],
        bases: NDArray[np.float64],
        neighbors: NDArray[np.int64],
        device: torch.device,
    ) -> None:
        import torch

        itself = np.arange(len(coordinates))[:, None]
        strides = np.where(neighbors[:, :STRIDES] < 0, itself, neighbors[:, :STRIDES])
        self.points = torch.from_numpy(coordinates).to(device)  # (n, d)
        self.bases = torch.from_numpy(bases).to(device)  # (n, 2, d)
        self.strides = torch.from_numpy(np.hstack([itself, strides])).to(device)  # (n, 1 + k)
        # A particle leaves its point by no more than this, in R^d and in R^3, lest it walk off an open border
        # or off a fold; the median is no larger where some of the neighbours lie beyond a tear. A point at a
        # border has its neighbours on one side, twice as far: the least reach around it is that of the inside.
        reach, reach_in_space = (self.points.new_empty(len(self.points)) for _ in range(2))
        for rows in _blocks(self.points):
            apart = self.points[self.strides[rows, 1:]] - self.points[rows, None]  # (b, k, d)
            reach[rows] = _median_length(apart)
            reach_in_space[rows] = _median_length(apart[:, :, :3])
        self.reach = self._least_around(reach)  # (n,)
        self.reach_in_space = self._least_around(reach_in_space)  # (n,)

    def _least_around(self, values: torch.Tensor) -> torch.Tensor:
        """Return the least of the values (n,) at each point and its neighbours (n,)."""
        return values[self.strides].amin(dim=1)

    def project(self, x: torch.Tensor, nearest: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
        """Return particles (m, d) projected to the surface, and their nearest points (m,).

        The nearest point is looked for among the neighbours *along the surface* of the last one, so a
        particle cannot jump to the other side of a thin wall.
        """
        nearby = self.strides[nearest]  # (m, 1 + k)
        nearest = nearby.gather(1, _distances(x, self.points[nearby]).argmin(dim=1, keepdim=True))[:, 0]  # (m,)
        base, basis = self.points[nearest], self.bases[nearest]  # (m, d), (m, 2, d)
        offset = ((basis @ (x - base)[:, :, None]).mT @ basis)[:, 0]  # (m, d)
        share = offset.norm(dim=1) / self.reach[nearest]  # (m,)
        longest = share.maximum(offset[:, :3].norm(dim=1) / self.reach_in_space[nearest])
        return base + offset / longest.clamp_min(1)[:, None], nearest


def spread_particles(
    coordinates: NDArray[np.float64],
    bases: NDArray[np.float64],
    neighbors: NDArray[np.int64],
    count: int,
    *,
    options: ParticleOptions | None = None,
    progress: PhaseCallback | None = None,
    device: str = EmbeddingOptions.device,
    placed: Particles | None = None,
    free: NDArray[np.bool_] | None = None,
) -> Particles:
    """Spread `count` particles evenly over a surface in R^d.

    From farthest-point samples, particles descend the energy ``sum exp(-|x_i - x_j|^2 / 4 sigma^2)`` by its
    closed-form force, and are projected to the tangent plane of the nearest point after each step (HD-PEA,
    sections 3.2, A and B). ``sigma = KERNEL_WIDTH sqrt(area / count)``, with the area of the restricted Voronoi
    cells: the estimate of HD-PEA counts every neighbourhood twelve times.

    Parameters
    ----------
    coordinates
        (n, d) float64, n >= count.
    bases
        (n, 2, d) float64, orthonormal.
    neighbors
        (n, k >= 12) int64 along the surface, nearest first, padded with -1.
    device
        On which the particles take their steps; their neighbours are found on the CPU.
    placed
        Particles that are there already and stay where they are, beside which `count` others spread.
    free
        (n,) bool: the points without these, from which the others begin, at least `count`.

    Returns
    -------
    Particles
        The `count` that were spread.
    """
    import torch

    options = options or ParticleOptions()
    iterations = ITERATIONS if options.iterations is None else options.iterations
    with core_errors_translated():
        seeds = _seeds(coordinates, count, options.seed, placed, free)
        beside = Particles(coordinates[:0], seeds[:0]) if placed is None else placed
        starts = np.vstack([coordinates[seeds], beside.coordinates])
        cells, _ = restricted_cells(starts, bases[np.concatenate([seeds, beside.nearest])], AREA_DISK_RADIUS)
        areas = np.minimum(cells.cell_areas, MOST_AREA * np.median(cells.cell_areas))
        squared_width = KERNEL_WIDTH**2 * float(areas.sum()) / len(starts)
        cloud = _Cloud(coordinates, bases, neighbors, torch_device(device))
        nearest = torch.tensor(seeds, device=cloud.points.device)  # (m,)
        x = cloud.points[nearest]  # (m, d)
        still = torch.from_numpy(beside.coordinates).to(x.device)  # (p, d)
        velocity = torch.zeros_like(x)  # (m, d)
        for step in range(iterations):
            if progress is not None and not progress(step / iterations):
                raise _core.Cancelled("cancelled")
            everyone = torch.cat([x, still])  # (m + p, d), while x is moved
            if step % REFRESH == 0:
                found = _core.nearest_neighbors(everyone.cpu().numpy(), min(INTERACTIONS, len(starts) - 1))
                others = torch.from_numpy(found[:count]).to(x.device)  # (m, k)
            size = STEP * DECAY ** (step // DECAY_EVERY)
            for rows in _blocks(x):
                force = _force(x[rows], everyone[others[rows]], squared_width)
                moved, nearest[rows] = cloud.project(x[rows] + MOMENTUM * velocity[rows] + size * force, nearest[rows])
                # What the projection took away must not push on in the next step.
                velocity[rows] = moved - x[rows]
                x[rows] = moved
    return Particles(x.cpu().numpy(), nearest.cpu().numpy())


def _seeds(
    coordinates: NDArray[np.float64],
    count: int,
    seed: int,
    placed: Particles | None,
    free: NDArray[np.bool_] | None,
) -> NDArray[np.int64]:
    """Return points (count,) far from each other, and from the particles that are placed, in the order of space."""
    if placed is None or free is None:
        seeds = _core.farthest_point_sampling(coordinates, count, [seed % len(coordinates)])
    else:
        given = np.unique(placed.nearest)
        rows = np.concatenate([given, np.setdiff1d(np.flatnonzero(free), given)])
        first = list(range(len(given)))
        seeds = rows[_core.farthest_point_sampling(coordinates[rows], len(first) + count, first)[len(first) :]]
    return np.asarray(seeds[spatial_order(coordinates[seeds, :3])])


def _blocks(tensor: torch.Tensor) -> Iterator[slice]:
    """Yield the rows of a tensor, so many at a time as its device is fast with."""
    at_once = AT_ONCE if tensor.device.type == "cpu" else max(len(tensor), 1)
    for first in range(0, len(tensor), at_once):
        yield slice(first, first + at_once)


def _force(x: torch.Tensor, others: torch.Tensor, squared_width: float) -> torch.Tensor:
    """Return sigma^2 times the force on each particle (m, d) by `others` (m, k, d): its energy's negative gradient."""
    kernel = (_distances(x, others).square() / (-4 * squared_width)).exp()  # (m, k)
    return x * kernel.sum(dim=1, keepdim=True) - (kernel[:, None] @ others)[:, 0]


def _distances(x: torch.Tensor, others: torch.Tensor) -> torch.Tensor:
    """Return the distances (m, k) of rows (m, d) from their `others` (m, k, d), without their differences in memory."""
    import torch

    # Products of matrices would lose the digits of what is near.
    return torch.cdist(x[:, None], others, compute_mode="donot_use_mm_for_euclid_dist")[:, 0]


def _median_length(vectors: torch.Tensor) -> torch.Tensor:
    """Return the median length (n,) of each row of vectors (n, k, d) that are not zero; tiny if all are."""
    lengths = vectors.norm(dim=2)  # (n, k)
    median: torch.Tensor = lengths.where(lengths > 0, float("nan")).nanmedian(dim=1).values
    return median.nan_to_num(1e-300)
