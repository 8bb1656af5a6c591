# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise taken from the points before all else."""

from __future__ import annotations

from dataclasses import replace

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.noise import roughness_of
from hdpea.normals import OrientedSurface
from hdpea.options import ROUGH, DenoisingOptions
from hdpea.progress import ProgressCallback, tell
from hdpea.report import Choice
from hdpea.surface import Surface

ROUNDS = 2
"""The second fits along the normals that the first one found, and with the neighbours that they tell."""


def denoised(
    oriented: OrientedSurface, options: DenoisingOptions, progress: ProgressCallback | None = None
) -> tuple[Surface, tuple[Choice, ...]]:
    """Return the surface with its points moved to where their neighbours show it and the normals there, and why.

    Moving least squares (Alexa et al., 2003): each point is moved along its normal onto the quadric that fits its
    neighbours of the same sheet, those of another direction counting less, so that edges stay. The points keep their
    order and frame, and are always fitted as they were given: more rounds do not shrink the shape. Two sheets that
    face the same way within the reach of the neighbours are drawn to each other.

    With ``denoise="none"``, and where ``"auto"`` finds the points smooth, the surface is returned as it is.
    """
    options, choices = _chosen(oriented, options)
    surface = oriented.surface
    if options.denoise == "none":
        return surface, choices
    places, normals = surface.points_in_unit, surface.normals
    with core_errors_translated():
        nearest = _core.nearest_neighbors(surface.points_in_unit, options.denoise_neighbors)
        for number in range(ROUNDS):
            tell(progress, "denoising", number / ROUNDS)
            neighbors = _core.sheet_neighbors(surface.points_in_unit, normals, nearest)
            moved = _core.moving_least_squares(places, normals, surface.points_in_unit, neighbors)
            places, normals = moved.points, moved.normals
    tell(progress, "denoising", 1)
    return Surface.of(surface.frame, places, normals), choices


def _chosen(oriented: OrientedSurface, options: DenoisingOptions) -> tuple[DenoisingOptions, tuple[Choice, ...]]:
    """Return the options with a way of denoising in place of ``auto``, and why it is that one.

    Estimated normals err where walls are thin, and the fit parts their sides; given ones do not, and are only blurred.
    """
    if options.denoise != "auto":
        return options, ()
    roughness = roughness_of(oriented.surface.points_in_unit)
    way = "mls" if (roughness.deviation if oriented.estimated else roughness.noise) > ROUGH else "none"
    kind = "" if roughness.like_noise else ", though not as if by noise"
    why = f"{roughness}{kind}; mls mends more than it blurs from {ROUGH:g} on"
    return replace(options, denoise=way), (Choice("denoise", way, "", why),)
