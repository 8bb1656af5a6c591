# SPDX-License-Identifier: GPL-3.0-or-later
"""Noise taken from the points before all else."""

from __future__ import annotations

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.options import DenoisingOptions
from hdpea.options.choice import Choice
from hdpea.options.denoising import FEWEST_FITTED, MOST_FITTED, ROUGH
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.surface.normals import OrientedSurface
from hdpea.surface.roughness import Roughness
from hdpea.surface.surface import Surface

ROUNDS = 2
"""The second fits along the normals that the first one found, and with the weights that they give."""

NEIGHBORS_OF_NOISE, STEP = 320, 40
"""Neighbours for noise of one spacing; they go with its square, so that as much of it is left.

In steps, lest it matter which points its measure has looked at."""


def denoised(
    oriented: OrientedSurface, options: DenoisingOptions, progress: ProgressCallback | None = None
) -> tuple[Surface, tuple[Choice, ...]]:
    """Return the surface with its points moved to where their neighbours show it and the normals there, and why.

    Moving least squares (Alexa et al., 2003): each point is moved along its normal onto the quadric that fits its
    neighbours, those of another direction counting less, so that edges and the far sides of walls stay. The points keep
    their order and frame, and are always fitted as they were given: more rounds do not shrink the shape. Two sheets
    that face the same way within the reach of the neighbours are drawn to each other.

    With ``denoise="none"``, and where ``"auto"`` finds the points smooth, the surface is returned as it is.
    """
    surface = oriented.surface
    if options.denoise == "none":
        return surface, ()
    roughness = oriented.roughness
    way, choices = _chosen(options, roughness, oriented.estimated > 0)
    if way == "none":
        return surface, choices
    count = options.denoise_neighbors
    if count is None:
        count = STEP * round(NEIGHBORS_OF_NOISE * roughness.deviation**2 / STEP)
        count = max(FEWEST_FITTED, min(count, MOST_FITTED))
        choices += (Choice("denoise_neighbors", count, "points", str(roughness)),)
    places, normals = surface.points_in_unit, surface.normals
    with core_errors_translated():
        # Not only those of the same sheet: noise lifts neighbours off it, and the weights see the far side of walls.
        nearest = _core.nearest_neighbors(surface.points_in_unit, count)
        for number in range(ROUNDS):
            tell(progress, "denoising", number / ROUNDS)
            moved = _core.moving_least_squares(places, normals, surface.points_in_unit, nearest)
            places, normals = moved.points, moved.normals
    tell(progress, "denoising", 1)
    return Surface.of(surface.frame, places, normals), choices


def _chosen(options: DenoisingOptions, roughness: Roughness, estimated: bool) -> tuple[str, tuple[Choice, ...]]:
    """Return the way of denoising, and why if it was chosen.

    Estimated normals err where walls are thin, and the fit parts their sides; given ones do not, and are only blurred.
    """
    if options.denoise != "auto":
        return options.denoise, ()
    way = "mls" if (roughness.deviation if estimated else roughness.noise) > ROUGH else "none"
    kind = "" if roughness.like_noise else ", though not as if by noise"
    why = f"{roughness}{kind}; mls mends more than it blurs from {ROUGH:g} on"
    return way, (Choice("denoise", way, "", why),)
