# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of the normals that came with a cloud are taken: decided here, once, before anything is made of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea.errors import UnreadableInput, core_errors_translated
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import NormalOptions
from hdpea.surface.contrary_normals import contrary_normals
from hdpea.surface.plausibility import are_normals


@dataclass(frozen=True)
class GivenNormals:
    """Directions that came with points, and what is taken of them.

    Attributes
    ----------
    directions
        (n, 3) float64 of length 1, or 0 where there is none.
    usable
        (n,) bool: which are taken for normals; the others are to be estimated.
    refused
        How many directions are no normals.
    """

    directions: NDArray[np.float64]
    usable: NDArray[np.bool_]
    refused: int = 0


def judged_normals(
    points_in_world: NDArray[np.float64], normals: NDArray[np.float64] | None, options: NormalOptions
) -> GivenNormals:
    """Judge the normals (n, 3) of points (n, 3), which are of length 1 or 0, as far as the options leave that open.

    Raises
    ------
    CannotReconstruct
        If all points are equal.
    UnreadableInput
        If the options demand the file's normals, and some are unusable.
    """
    given = np.zeros_like(points_in_world) if normals is None else normals
    usable: NDArray[np.bool_] = np.asarray(given.any(axis=1))
    if options.normals == "file" and not usable.all():
        raise UnreadableInput(
            f"{int((~usable).sum())} points have no usable normal.", "Use `normals='auto'` to estimate those."
        )
    if options.normals == "estimate":
        return GivenNormals(given, np.zeros_like(usable))
    if options.normals == "file" or not usable.any():
        return GivenNormals(given, usable)
    points = UnitFrame.around(points_in_world).to_unit(points_in_world)
    with core_errors_translated():
        refused = usable & contrary_normals(points, given) if are_normals(points, given) else usable
    return GivenNormals(given, usable & ~refused, int(refused.sum()))
