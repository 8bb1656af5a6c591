# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise taken from the points before all else."""

from __future__ import annotations

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.options import DenoisingOptions
from hdpea.progress import ProgressCallback, tell
from hdpea.surface import Surface

ROUNDS = 2
"""The second fits along the normals that the first one found, and with the neighbours that they tell."""


def denoised(
    surface: Surface, options: DenoisingOptions | None = None, progress: ProgressCallback | None = None
) -> Surface:
    """Return the surface with its points moved to where their neighbours show it, and the normals there.

    Moving least squares (Alexa et al., 2003): each point is moved along its normal onto the quadric that fits its
    neighbours of the same sheet, those of another direction counting less, so that edges stay. The points keep their
    order and frame, and are always fitted as they were given: more rounds do not shrink the shape. Two sheets that
    face the same way within the reach of the neighbours are drawn to each other.

    With ``denoise="none"`` the surface is returned as it is.
    """
    options = options or DenoisingOptions()
    if options.denoise == "none":
        return surface
    places, normals = surface.points_in_unit, surface.normals
    with core_errors_translated():
        nearest = _core.nearest_neighbors(surface.points_in_unit, options.denoise_neighbors)
        for number in range(ROUNDS):
            tell(progress, "denoising", number / ROUNDS)
            neighbors = _core.sheet_neighbors(surface.points_in_unit, normals, nearest)
            moved = _core.moving_least_squares(places, normals, surface.points_in_unit, neighbors)
            places, normals = moved.points, moved.normals
    tell(progress, "denoising", 1)
    return Surface.of(surface.frame, places, normals)
