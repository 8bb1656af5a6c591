# SPDX-License-Identifier: GPL-3.0-or-later
"""Two scans of one surface that do not meet: told from the sides of walls by the motion between them, and moved."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hdpea.frontend.patches import QUADRIC, Patches, deviation
from hdpea.geometry.thinning import rows_along
from hdpea.geometry.unit_frame import UnitFrame

Vectors = NDArray[np.float64]

SAMPLES = 2_000
"""Points around which it is looked how far apart the scans are."""

REACHES = (24, 48)
"""Nearest points that a quadric is fitted to: few show what bends, many see layers that are two spacings apart."""

SMOOTH = 0.1
"""Median deviation from quadrics, in spacings, under which there are no layers."""

FOLLOWING = 0.8
"""Share of the places that the motion is fitted to: those that follow it best. Thin parts follow none."""

EXPLAINED, LEFT = 0.6, 0.2
"""Least share of the variance among these that a motion explains, and the most of the median deviation, squared, that
is left when it is undone.

Of 504 clouds of half of the training meshes (3,000 to 20,000 points, a quarter with noise of 0.3 % of the diagonal) two
had both, of one tray, before there was ``ONE_WAY``; of 500 of the other half, with it, none. Of smooth shapes seen
twice, 0.7 to 2.2 spacings apart, nearly all have; of parts with thin walls few."""

ONE_WAY = 0.85
"""Share of the motion across the surface along one direction from which on it may be the thickness of plates.

Of a sphere it is 0.6, of a box 0.5 to 1; the single training mesh that passed for two scans, a tray, has 0.89."""

LEVER = 3.0
"""By how much coordinates in the unit frame are stretched, so that rotations move points as far as velocities do."""

LEAST = 0.1
"""Root mean square of half the distance, in spacings, from which on scans are moved."""

ROUNDS, TRIMS, STEPS = 3, 3, 20
"""Most motions that are undone one after the other, how often the places are chosen, and the steps of each fit."""

CHUNK = 20_000
"""Points that are looked at at once, which bounds the memory."""


class _Motion(NamedTuple):
    """Half the motion from one scan to the other, and how well it is known.

    ``half`` (6,) is a velocity and a rotation in units of ``spacing``; ``amplitude`` how far it moves points across the
    surface, ``one_way`` which share of that along one direction; ``variance`` is what it was fitted to.
    """

    half: Vectors
    explained: float
    amplitude: float
    one_way: float
    reach: int
    spacing: float
    variance: float


class Met(NamedTuple):
    """Two scans that were moved together.

    Attributes
    ----------
    points
        (n, 3) float64, where they are now.
    apart
        How far apart the two were, across the surface: root mean square, in the unit of the points.
    """

    points: Vectors
    apart: float


def moved_together(points: Vectors) -> Met | None:
    """Move two scans of one surface together that do not meet, of points (n, 3); None if they are no such scans.

    Layers a few spacings apart are two scans of one surface, or the sides of a thin wall. Scans are apart by one rigid
    motion: by (v + w x p) . n where the normal is n, and by nothing where that is 0. Walls have a thickness of their
    own. So a motion is fitted to how far points lie off quadrics around them; on which side tells to which scan each
    belongs, and both go half of the way.
    """
    frame = UnitFrame.around(points)
    moved, apart = frame.to_unit(points), 0.0
    for _ in range(ROUNDS):
        motion = _motion_of(moved)
        if motion is None or motion.explained < EXPLAINED or motion.amplitude < LEAST or motion.one_way > ONE_WAY:
            break
        undone = _undone(moved, motion)
        if _variance(undone, motion.reach, motion.spacing) > LEFT * motion.variance:
            break
        moved, apart = undone, max(apart, 2 * motion.amplitude * motion.spacing)
    return Met(frame.to_world(moved), apart * frame.diagonal) if apart > 0 else None


def _motion_of(points: Vectors) -> _Motion | None:
    """Return the motion between two scans that explains most of how far points (n, 3) are off quadrics."""
    motions = list[_Motion]()
    rows = rows_along(len(points), SAMPLES)
    for reach in REACHES:
        if len(points) <= 2 * reach:
            return None
        patches = Patches.around(points, rows, reach)
        spacing = float(np.median(patches.spacings))
        deviations = _deviations(patches, spacing)
        variance = float(np.median(deviations)) ** 2
        if reach == min(REACHES) and variance < SMOOTH**2:
            return None
        rates = _rates(points[rows], patches.normals)
        half, explained = _fitted(rates, np.square(deviations))
        across = (rates @ half)[:, None] * patches.normals
        squares = np.linalg.eigvalsh(np.einsum("ni,nj->ij", across, across) / len(across))
        one_way = float(squares[-1] / max(squares.sum(), np.finfo(np.float64).tiny))
        motions.append(_Motion(half, explained, float(np.sqrt(squares.sum())), one_way, reach, spacing, variance))
    return max(motions, key=lambda motion: motion.explained)


def _variance(points: Vectors, reach: int, spacing: float) -> float:
    """Return the median variance of points (n, 3) about quadrics, in squared spacings."""
    patches = Patches.around(points, rows_along(len(points), SAMPLES), reach)
    return float(np.median(_deviations(patches, spacing))) ** 2


def _deviations(patches: Patches, spacing: float) -> Vectors:
    """Return the deviations (m,) from quadrics, in spacings."""
    return deviation(patches.residuals(QUADRIC), QUADRIC) * patches.radii / spacing


def _rates(points: Vectors, normals: Vectors) -> Vectors:
    """Return how fast points (n, 3) move across the surface, (n, 6): for each velocity, and for each rotation."""
    return np.concatenate([normals, np.cross(LEVER * points, normals)], axis=1)


def _fitted(rates: Vectors, variances: Vectors) -> tuple[Vectors, float]:
    """Fit half a motion h (6,) such that the variances (m,) are (rates h)^2 + c, and return the share it explains.

    Two layers that are 2 d apart have the variance d^2.
    """
    kept, half = np.ones(len(rates), dtype=bool), np.zeros(6)
    for _ in range(TRIMS):
        half, rest = _refined(rates[kept], variances[kept], _first_guess(rates[kept], variances[kept]))
        off = abs(variances - np.square(rates @ half) - rest)
        kept = off <= np.quantile(off, FOLLOWING)
    spread = np.square(variances[kept] - variances[kept].mean()).sum()
    return half, float(1 - np.square(off[kept]).sum() / spread) if spread > 0 else 0.0


def _first_guess(rates: Vectors, variances: Vectors) -> Vectors:
    """Return half a motion (6,): the squares in ``_fitted`` are linear in its products, whose main axis it is."""
    first, second = np.triu_indices(6)
    products = rates[:, first] * rates[:, second] * np.where(first == second, 1, 2)
    design = np.concatenate([products, np.ones((len(rates), 1))], axis=1)
    # Sums in a fixed order, whatever the number of threads.
    normal, right = np.einsum("ni,nj->ij", design, design), np.einsum("ni,n->i", design, variances)
    found = np.linalg.pinv(normal, rcond=1e-6, hermitian=True) @ right
    matrix = np.zeros((6, 6))
    matrix[first, second] = matrix[second, first] = found[:-1]
    values, axes = np.linalg.eigh(matrix)
    return np.asarray(axes[:, -1] * np.sqrt(max(values[-1], np.finfo(np.float64).eps)))


def _refined(rates: Vectors, variances: Vectors, half: Vectors) -> tuple[Vectors, float]:
    """Return half a motion (6,) and the variance of the rest, by Gauss-Newton steps from a guess."""
    rest = float((variances - np.square(rates @ half)).mean())
    for _ in range(STEPS):
        moved = rates @ half
        slopes = np.concatenate([2 * moved[:, None] * rates, np.ones((len(rates), 1))], axis=1)
        missing = variances - np.square(moved) - rest
        normal, right = np.einsum("ni,nj->ij", slopes, slopes), np.einsum("ni,n->i", slopes, missing)
        # A rotation that moves nothing, as of a sphere, stays as it is.
        step = np.linalg.solve(normal + 1e-4 * np.trace(normal) * np.eye(7), right)
        half, rest = half + step[:6], rest + float(step[6])
    return half, rest


def _undone(points: Vectors, motion: _Motion) -> Vectors:
    """Move points (n, 3) half of the way to the other scan: by which side of the quadric around it each is on."""
    velocity, rotation = motion.spacing * motion.half[:3], motion.spacing * motion.half[3:]
    ways = velocity + np.cross(rotation, LEVER * points)
    moved = points.copy()
    for rows in np.array_split(np.arange(len(points)), len(points) // CHUNK + 1):
        patches = Patches.around(points, rows, motion.reach)
        heights = patches.residuals(QUADRIC)[:, 0]
        sides = np.sign(heights * np.einsum("nc,nc->n", ways[rows], patches.normals))
        moved[rows] -= sides[:, None] * ways[rows]
    return moved
