# SPDX-License-Identifier: GPL-3.0-or-later
"""Denoising of the points by moving least squares."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.frontend.roughness import Roughness
from hdpea.options import DenoisingOptions
from hdpea.options.choice import Choice
from hdpea.options.denoising import FEWEST_FITTED, MOST_FITTED, ROUGH
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.surface.layers import have_layers, layered_region, mean_normals
from hdpea.surface.normals import OrientedSurface
from hdpea.surface.surface import Surface

Vectors = NDArray[np.float64]

LAYERED = "layers face the same way a few spacings apart: one surface, scanned twice"

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

    Layers that face the same way are drawn to each other whatever else is chosen, with the most neighbours: they are
    misplaced scans of one surface.

    With ``denoise="none"``, and where ``"auto"`` finds the points smooth, the surface is returned as it is.
    """
    surface = oriented.surface
    if options.denoise == "none":
        return surface, ()
    roughness = oriented.roughness
    method, choices = _method(options, roughness, oriented.estimated > 0)
    strips = oriented.doubled or oriented.seams
    with core_errors_translated():
        layered = options.denoise == "auto" and _are_scanned_twice(oriented)
        if layered and strips:
            surface = replace(surface, normals=mean_normals(surface.points_in_unit, surface.normals))
    if layered:
        method, choices = "mls", (Choice("denoise", "mls", "", LAYERED),)
    if method == "none":
        return surface, choices
    count = options.denoise_neighbors
    if count is None:
        count = STEP * round(NEIGHBORS_OF_NOISE * roughness.deviation**2 / STEP)
        count = MOST_FITTED if layered else max(FEWEST_FITTED, min(count, MOST_FITTED))
        choices += (Choice("denoise_neighbors", count, "points", LAYERED if layered else str(roughness)),)
    with core_errors_translated():
        points, normals = _fitted(surface, count, progress)
        if layered and roughness.deviation <= ROUGH:
            rows = layered_region(surface.points_in_unit, surface.normals, doubled=strips)
            points, normals = _in_layers(oriented.surface, rows, points, normals)
    tell(progress, "denoising", 1)
    return Surface.of(surface.frame, points, normals), choices


def _are_scanned_twice(oriented: OrientedSurface) -> bool:
    """Tell whether layers that face the same way are misplaced scans of one surface.

    Noise as wide as the points are apart lifts points above others, too. And where walls are thin, sides may be wrong
    that were computed, or are those of estimated normals turned to their sensors. Trees are no second scan of the
    ground below.
    """
    sure = oriented.method == "file" or oriented.seams or (oriented.from_above and not oriented.overhung)
    if not sure or oriented.roughness.noise > ROUGH:
        return False
    return oriented.doubled or have_layers(oriented.surface.points_in_unit, oriented.surface.normals)


def _fitted(surface: Surface, count: int, progress: ProgressCallback | None) -> tuple[Vectors, Vectors]:
    """Return the points (n, 3) on the fit of so many neighbours, and the normals there."""
    points, normals = surface.points_in_unit, surface.normals
    # Of all sheets: noise lifts neighbours off their own, and the weights discount the far side of walls.
    nearest = _core.nearest_neighbors(surface.points_in_unit, min(count, len(points) - 1))
    for number in range(ROUNDS):
        tell(progress, "denoising", number / ROUNDS)
        moved = _core.moving_least_squares(points, normals, surface.points_in_unit, nearest)
        points, normals = moved.points, moved.normals
    return points, normals


def _in_layers(surface: Surface, rows: NDArray[np.int64], points: Vectors, normals: Vectors) -> tuple[Vectors, Vectors]:
    """Keep the fitted points and normals (n, 3) in the rows (m,) where layers lie, and those given elsewhere."""
    kept_points, kept_normals = surface.points_in_unit.copy(), surface.normals.copy()
    kept_points[rows], kept_normals[rows] = points[rows], normals[rows]
    return kept_points, kept_normals


def _method(options: DenoisingOptions, roughness: Roughness, estimated: bool) -> tuple[str, tuple[Choice, ...]]:
    """Return the method of denoising, and why if it was chosen.

    Estimated normals err where walls are thin, and the fit separates the sides; given ones do not err, and would only
    be blurred.
    """
    if options.denoise != "auto":
        return options.denoise, ()
    method = "mls" if (roughness.deviation if estimated else roughness.noise) > ROUGH else "none"
    kind = "" if roughness.like_noise else ", as its shape is rather than its noise"
    why = f"{roughness}{kind}; mls is worth it from {ROUGH:g} on"
    return method, (Choice("denoise", method, "", why),)
