# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals: taken from the file where they are usable, else estimated; always consistently oriented."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import UnreadableInput, core_errors_translated
from hdpea.frame import UnitFrame
from hdpea.options import NormalOptions
from hdpea.progress import ProgressCallback, tell
from hdpea.report import Choice
from hdpea.surface import NEIGHBORS, Surface, require_surface

TRUSTED_CONSISTENCY = 0.9
"""Share of neighbours in agreement from which the file's orientation is taken as it is; random signs have 0.5."""

ORIENTATION_NEIGHBORS = 16
"""Nearest points to which a point hands on its orientation, and fewest that an estimated normal is fitted to."""


@dataclass(frozen=True)
class OrientedSurface:
    """A surface, and how it came by its normals.

    Attributes
    ----------
    estimated
        How many normals had to be estimated.
    consistency
        Share of neighbours whose given normals agreed in orientation; None without given normals.
    reoriented
        Whether the orientation was made anew.
    choices
        What was chosen automatically.
    """

    surface: Surface
    estimated: int
    consistency: float | None
    reoriented: bool
    choices: tuple[Choice, ...] = ()


def oriented_surface(
    points_in_world: NDArray[np.float64],
    normals: NDArray[np.float64] | None = None,
    options: NormalOptions | None = None,
    points_per_vertex: float = 8.0,
    progress: ProgressCallback | None = None,
) -> OrientedSurface:
    """Move a cloud to its unit frame and give it consistently oriented normals.

    Given normals keep their directions; their signs are kept only if neighbours agree about them, so a
    cloud whose normals point both ways gives the same surface as one that is well oriented.

    Parameters
    ----------
    points_in_world
        (n, 3) float64, finite and distinct.
    normals
        (n, 3) float64 of length 1, or 0 where unusable.
    points_per_vertex
        Points for each vertex that the mesh will have: with more, normals are fitted to more neighbours, so
        that noise averages out in a redundant cloud.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    UnreadableInput
        If the file's normals are insisted on and some are unusable.
    """
    options = options or NormalOptions()
    given = np.zeros_like(points_in_world) if normals is None else normals
    usable: NDArray[np.bool_] = np.asarray(given.any(axis=1))
    if options.normals == "file" and not usable.all():
        raise UnreadableInput(
            f"{int((~usable).sum())} points have no usable normal.", "Use --normals auto to estimate those."
        )
    if options.normals == "estimate":
        usable[:] = False
    frame = UnitFrame.around(points_in_world)
    points = frame.to_unit(points_in_world)
    require_surface(points)
    tell(progress, "normals", 0)
    choices: tuple[Choice, ...] = ()
    with core_errors_translated():
        neighbors = _core.nearest_neighbors(points, NEIGHBORS)
        nearest = np.ascontiguousarray(neighbors[:, :ORIENTATION_NEIGHBORS])
        directions = given.copy()
        if not usable.all():
            count = options.normal_neighbors
            if count is None:
                count = min(max(ORIENTATION_NEIGHBORS, round(2 * points_per_vertex)), NEIGHBORS)
                why = f"twice the points per vertex, from {ORIENTATION_NEIGHBORS} to {NEIGHBORS}"
                choices = (Choice("normal_neighbors", count, "points", why),)
            fitted = neighbors if count <= NEIGHBORS else _core.nearest_neighbors(points, count)
            estimated = _core.estimate_normals(points, np.ascontiguousarray(fitted[:, :count]))
            directions[~usable] = estimated[~usable]
        tell(progress, "normals", 0.5)
        # Estimated normals have no sign yet; as zeros they have no say.
        signed = np.where(usable[:, None], directions, 0)
        consistency = _core.orientation_consistency(points, signed, nearest) if usable.any() else None
        trusted = consistency is not None and consistency >= TRUSTED_CONSISTENCY
        if not (trusted and usable.all()):
            oriented = _core.orient_normals(points, directions, nearest)
            directions = _with_given_signs(points, oriented, directions, usable) if trusted else oriented
    tell(progress, "normals", 1)
    surface = Surface.of(frame, points, directions, neighbors)
    return OrientedSurface(surface, int((~usable).sum()), consistency, not trusted, choices)


def _with_given_signs(
    points: NDArray[np.float64],
    oriented: NDArray[np.float64],
    directions: NDArray[np.float64],
    usable: NDArray[np.bool_],
) -> NDArray[np.float64]:
    """Keep the usable `directions` (n, 3), and turn the `oriented` others as the nearest usable one has it."""
    kept = np.einsum("nc,nc->n", oriented, directions)[usable] >= 0
    nearest_usable = _core.nearest_neighbors(points[usable], points[~usable], 1)[:, 0]
    signed = directions.copy()
    signed[~usable] = np.where(kept[nearest_usable], 1, -1)[:, None] * oriented[~usable]
    return signed
