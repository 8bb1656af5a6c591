# SPDX-License-Identifier: GPL-3.0-or-later
"""How many vertices noise allows, and which error: what finer triangles would show is noise."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.geometry.thinning import rows_along
from hdpea.options import Options
from hdpea.options.choice import Choice
from hdpea.options.denoising import ROUGH
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.surface.preparation import Preparation
from hdpea.surface.surface import area_shown

MISSED = 0.5
"""Variance that wider planes may miss, for each that noise leaves at a vertex.

Twenty thousand points of four training meshes and a sphere with noise of half a spacing to a whole one get half as many
vertices, or a quarter, and lie 0.98 times as far off the truth as with one for every 8 points (0.94 to 1.05)."""

SAMPLES = 1_000
"""Points at which it is measured what a plane misses."""

FEWER = (16, 32, 64)
"""Points per vertex that may be enough, one after the other: the most are those of a flat wall.

What planes of more points miss is less than chance tells: a sphere of 20,000 with noise of 1.4 spacings and a share of
outliers was given one for every 128, and its error grew by 7 %."""

PER_VERTEX = (POINTS_PER_VERTEX, *FEWER)
"""All points per vertex for which it counts what planes miss."""

PLANE = 2
"""Points of a plane for each point per vertex: on a sphere a plane through 1.25 misses as much as triangles do."""

DEVIATIONS = 3.5
"""Standard deviations of the noise that an error leaves room for, or the mesh follows the noise.

639,349 points of terrain with noise of 2.6 cm are shown by 2,659 triangles within 10 cm, by 6,302 within 9, by 16,033
within 8 and by 133,966 within 6."""


def within_noise(options: Options, prepared: Preparation, points_shown: int) -> tuple[Options, tuple[Choice, ...]]:
    """Ask for fewer vertices where nothing was asked for and noise hides what as many as the points allow would show.

    A vertex that p points are fitted to keeps 1 / p of the variance of their noise. So p is doubled as long as planes
    as wide as the triangles miss less than half of that: these leave out less than noise adds. Points that are but a
    little rough, or in a way that noise is not, are shown in full.

    Returns
    -------
    options
        With a number of vertices if it is less than one for every 8 points.
    choices
        That number and why.
    """
    noise = prepared.oriented.roughness.noise
    return within_measured_noise(options, noise, lambda fewer: missed_by_planes(prepared, fewer), points_shown)


def within_measured_noise(
    options: Options, noise: float, missed: Callable[[int], float | None], points_shown: int
) -> tuple[Options, tuple[Choice, ...]]:
    """Decide as ``within_noise`` does, by what was measured elsewhere, such as in the tiles of a cloud.

    Parameters
    ----------
    noise
        Of the points, in spacings.
    missed
        For a number of points per vertex, what ``missed_by_planes`` measures.
    """
    if not any_number(options) or noise <= ROUGH or (least := missed(POINTS_PER_VERTEX)) is None:
        return options, ()
    per_vertex = POINTS_PER_VERTEX
    for fewer in FEWER:
        variance = missed(fewer)
        if variance is None or variance > least * (1 + MISSED / fewer):
            break
        per_vertex = fewer
    if per_vertex == POINTS_PER_VERTEX:
        return options, ()
    vertices = options.vertices_of(points_shown * POINTS_PER_VERTEX // per_vertex)
    why = f"one for every {per_vertex} points: finer triangles would show their noise, {noise:.2g} spacings"
    chosen = replace(options, meshing=replace(options.meshing, vertices=vertices))
    return chosen, (Choice("vertices", vertices, "", why),)


def any_number(options: Options) -> bool:
    """Return whether nobody asks for a number of vertices, nor for what decides it."""
    return options.meshing.any_size and options.meshing.error is None and options.particles.particles is None


def error_within_noise(options: Options, prepared: Preparation) -> tuple[str, ...]:
    """Return a sentence for the user if an error is asked for that leaves no room for the noise."""
    error, surface, roughness = options.meshing.error, prepared.surface, prepared.oriented.roughness
    if error is None or prepared.denoised:
        return ()
    spacing = np.sqrt(area_shown(surface.points_in_unit, surface.neighbors) / len(surface.points_in_unit))
    least = DEVIATIONS * roughness.noise * float(spacing)
    if surface.frame.length_to_unit(error) >= least:
        return ()
    told = f"The `error` is less than {least * surface.frame.diagonal:.2g}, which the noise of the points needs"
    return (f"{told}: the mesh follows the noise, with many triangles.",)


def missed_by_planes(prepared: Preparation, per_vertex: int, among: NDArray[np.int64] | None = None) -> float | None:
    """Return the variance of points about planes as wide as triangles with so many points per vertex.

    It is that of their noise, and of what the surface bends, in the unit frame; None if there are too few points.

    Parameters
    ----------
    among
        Rows (m,) of the points at which it is measured; default: all.
    """
    surface, rough = prepared.surface, prepared.oriented.surface.points_in_unit
    among = np.arange(len(rough)) if among is None else among
    if PLANE * per_vertex >= len(rough) or len(among) == 0:
        return None
    rows = among[rows_along(len(among), SAMPLES)]
    middles, normals = np.ascontiguousarray(surface.points_in_unit[rows]), np.ascontiguousarray(surface.normals[rows])
    # Neighbours are those on the denoised surface: noise of a spacing makes balls of the nearest, whose planes lie
    # any way.
    nearest = _core.nearest_neighbors(surface.points_in_unit, middles, PLANE * per_vertex)
    heights = np.einsum("nkc,nc->nk", rough[nearest] - middles[:, None], normals)
    axes = _core.tangent_bases_across(normals).reshape(-1, 2, 3)
    along = np.einsum("nkc,ndc->nkd", surface.points_in_unit[nearest] - middles[:, None], axes)
    plane, _ = np.linalg.qr(np.concatenate([np.ones_like(along[:, :, :1]), along], axis=2))
    fitted = np.einsum("nkc,nc->nk", plane, np.einsum("nkc,nk->nc", plane, heights))
    return float(np.square(heights - fitted).sum(axis=1).mean() / (heights.shape[1] - plane.shape[2]))
