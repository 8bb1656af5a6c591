# SPDX-License-Identifier: GPL-3.0-or-later
"""Denoising of the points by moving least squares."""

from __future__ import annotations

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.frontend.roughness import Roughness
from hdpea.options import DenoisingOptions
from hdpea.options.choice import Choice
from hdpea.options.denoising import FEWEST_FITTED, MOST_FITTED, ROUGH
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.surface.normals import OrientedSurface
from hdpea.surface.surface import Surface

ROUNDS = 2
"""The second round fits along the normals that the first one found, with the weights that they give."""

NEIGHBORS_OF_NOISE, STEP = 320, 40
"""Neighbours for noise of one spacing, and the multiple that they are rounded to.

Their number grows with the square of the noise, which leaves a constant share of it. It is rounded so that it does not
depend on which points the roughness was measured at."""


def denoised(
    oriented: OrientedSurface, options: DenoisingOptions, progress: ProgressCallback | None = None
) -> tuple[Surface, tuple[Choice, ...]]:
    """Return the surface with its points moved onto the fit of their neighbours, with the normals there, and why.

    Moving least squares (Alexa et al., 2003): each point is moved along its normal onto the quadric that fits its
    neighbours, those whose normals differ counting less, so that edges and the far sides of walls stay. The points keep
    their order and frame, and are always fitted as they were given: more rounds do not shrink the shape. Two sheets
    that face the same side within the reach of the neighbours are drawn to each other.

    With ``denoise="none"``, and where ``"auto"`` finds the points smooth, the surface is returned as it is.
    """
    surface = oriented.surface
    if options.denoise == "none":
        return surface, ()
    roughness = oriented.roughness
    method, choices = _method(options, roughness, oriented.estimated > 0)
    if method == "none":
        return surface, choices
    count = options.denoise_neighbors
    if count is None:
        count = STEP * round(NEIGHBORS_OF_NOISE * roughness.deviation**2 / STEP)
        count = max(FEWEST_FITTED, min(count, MOST_FITTED))
        choices += (Choice("denoise_neighbors", count, "points", str(roughness)),)
    points, normals = surface.points_in_unit, surface.normals
    with core_errors_translated():
        # Of all sheets: noise lifts neighbours off their own, and the weights discount the far side of walls.
        nearest = _core.nearest_neighbors(surface.points_in_unit, min(count, len(points) - 1))
        for number in range(ROUNDS):
            tell(progress, "denoising", number / ROUNDS)
            moved = _core.moving_least_squares(points, normals, surface.points_in_unit, nearest)
            points, normals = moved.points, moved.normals
    tell(progress, "denoising", 1)
    return Surface.of(surface.frame, points, normals), choices


def _method(options: DenoisingOptions, roughness: Roughness, estimated: bool) -> tuple[str, tuple[Choice, ...]]:
    """Return the method of denoising, and why if it was chosen.

    Estimated normals err where walls are thin, and the fit separates the sides; given ones do not err, and would only
    be blurred.
    """
    if options.denoise != "auto":
        return options.denoise, ()
    method = "mls" if (roughness.deviation if estimated else roughness.noise) > ROUGH else "none"
    kind = "" if roughness.like_noise else ", though not by noise"
    why = f"{roughness}{kind}; mls is worth it from {ROUGH:g} on"
    return method, (Choice("denoise", method, "", why),)
