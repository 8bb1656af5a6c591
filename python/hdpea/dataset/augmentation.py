# SPDX-License-Identifier: GPL-3.0-or-later
"""Augmentation: samples rotated and mirrored, psi unchanged."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea.dataset.sample import Sample
from hdpea.errors import UsageError


def _quarter_turn(axis: int, sign: int) -> NDArray[np.float64]:
    turn = np.zeros((3, 3))
    turn[axis, axis] = 1
    first, second = (axis + 1) % 3, (axis + 2) % 3
    turn[second, first], turn[first, second] = sign, -sign
    return turn


def _mirroring(axis: int) -> NDArray[np.float64]:
    return np.diag(np.where(np.arange(3) == axis, -1.0, 1.0))


TRANSFORMS: dict[str, NDArray[np.float64]] = {
    "identity": np.eye(3),
    "x_plus_90": _quarter_turn(0, 1),
    "x_minus_90": _quarter_turn(0, -1),
    "y_plus_90": _quarter_turn(1, 1),
    "y_minus_90": _quarter_turn(1, -1),
    "z_plus_90": _quarter_turn(2, 1),
    "z_minus_90": _quarter_turn(2, -1),
    "mirrored_xy": _mirroring(2),
    "mirrored_xz": _mirroring(1),
    "mirrored_yz": _mirroring(0),
}
"""The ten transforms of the HD-PEA paper, appendix F (after NASM), by name: new = matrix @ old."""


def random_rotation(seed: int | np.random.Generator) -> NDArray[np.float64]:
    """Return a uniformly random rotation (3, 3) (Mezzadri, How to generate random matrices, 2007)."""
    orthogonal, triangular = np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))
    orthogonal *= np.sign(np.diag(triangular))  # makes the factors unique, so that no direction is preferred
    orthogonal[:, 0] *= np.sign(np.linalg.det(orthogonal))
    return orthogonal


def augmented(sample: Sample, matrix: NDArray[np.float64]) -> Sample:
    """Return the sample of the surface transformed by an orthogonal matrix (3, 3) about the origin of its unit frame.

    Lengths do not change, and neither do psi and the curvatures. Outward normals stay outward, mirrored or not, since
    they are normals of the transformed surface; the second direction, normal x direction1, changes its sign when
    mirrored, which is immaterial. The frame is kept: it places the transformed surface where the original was,
    rotated about the middle of its box. After a quarter turn or a reflection it is also the unit frame of that
    surface; after any other rotation the diagonal of its box is not 1, and lengths remain shares of the original's.

    Raises
    ------
    UsageError
        If the matrix is not orthogonal.
    """
    if matrix.shape != (3, 3) or not np.allclose(matrix @ matrix.T, np.eye(3), atol=1e-9):
        raise UsageError("A sample can be transformed only by an orthogonal matrix (3, 3).")

    def transformed(rows: NDArray[np.float32]) -> NDArray[np.float32]:
        return (rows @ matrix.T).astype(np.float32)

    return replace(
        sample,
        points=transformed(sample.points),
        surface_points=transformed(sample.surface_points),
        normals=transformed(sample.normals),
        direction1=transformed(sample.direction1),
        estimated_normals=None if sample.estimated_normals is None else transformed(sample.estimated_normals),
        sensors=None if sample.sensors is None else transformed(sample.sensors),
    )
