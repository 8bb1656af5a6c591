# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of the surface is out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import UnreadableInput, UsageError
from hdpea.geometry.thinning import rows_without
from hdpea.options import NormalOptions
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.agreement_of_signs import by_agreement
from hdpea.surface.sign_methods import by_file, by_neighbors, by_view, by_winding_number
from hdpea.surface.signs import Orientation, SignEvidence, Vectors, turned
from hdpea.surface.single_view import GRAZING, View, single_view
from hdpea.surface.visibility import MOST_HIDDEN, share_hidden

MOST_UNDERSIDES = 0.05
"""Largest share of points on undersides of land that was seen from above; of CGAL's b9_training it is 0.02, of a ball
on a floor of twice its points 0.15."""

MOST_DISAGREEMENT = 1 / 3
"""Largest share of the disagreement of neighbours that is left without sensors that cannot have seen the points.

Of eight complete models with sensors of other scans or frames, or one for all, it is 0 to 0.17; of hedges and the tops
of trees, through which sensors do see, 0.79 and more."""


def require_signs(given: Vectors, sensors: Vectors | None, options: NormalOptions) -> None:
    """Refuse to orient by what is not there.

    Raises
    ------
    UnreadableInput
        If the file is to say the signs, or the sensors' positions, and does not.
    UsageError
        If there is no viewpoint to orient towards.
    """
    if options.orient == "file" and not given.any():
        raise UnreadableInput("There are no usable normals whose orientation to keep.", "Use `orient='auto'`.")
    if options.orient == "viewpoint" and options.viewpoint is None:
        if sensors is None:
            raise UsageError(
                "There is no viewpoint to turn the normals to.",
                "Give a `viewpoint`, or properties sensor_x, sensor_y and sensor_z in the file.",
            )
        if not np.isfinite(sensors).all():
            raise UnreadableInput("Not every point's sensor position is finite.", "Give one `viewpoint`.")


def orient(
    points: Vectors,
    directions: Vectors,
    evidence: SignEvidence,
    method: str,
    seen_from: Vectors | None,
    progress: PhaseCallback | None,
    parts: tuple[NDArray[np.int64], ...],
) -> Orientation:
    """Give normals their signs by the given method of ``NormalOptions.orient``.

    Parameters
    ----------
    points, directions
        (n, 3) float64; the directions are of length 1, and their signs mean nothing yet.
    seen_from
        (n, 3) or (3,), the sensor of each point or of all; needed for the method ``viewpoint``.
    parts
        Rows of what lies in the scene and is no part of its surface: the method ``auto`` may choose another for each.
    """
    if method == "auto":
        return _by_best_method(points, directions, evidence, progress, parts)
    if method == "wnnc":
        return Orientation(by_winding_number(points, directions, evidence, progress), method)
    if method == "viewpoint" and seen_from is not None:
        return Orientation(turned(directions, seen_from - points), method)
    if method == "file":
        return Orientation(by_file(points, directions, evidence), method)
    return Orientation(by_neighbors(points, directions, evidence), method)


def _by_best_method(
    points: Vectors,
    directions: Vectors,
    evidence: SignEvidence,
    progress: PhaseCallback | None,
    parts: tuple[NDArray[np.int64], ...] = (),
) -> Orientation:
    signs = evidence.signs
    if signs is not None and signs.trusted:
        why = f"{signs.consistency:.0%} of neighbours agree on the side"
        return Orientation(by_file(points, directions, evidence), "file", why)
    if (without_sensors := _if_hidden(points, directions, evidence, progress)) is not None:
        return without_sensors
    view = _view(points, directions, evidence)
    # A ball on the ground may be so small a share of the points that all seem to be a height field.
    if parts and not (view is not None and (view.from_one_place or evidence.sensors is not None)):
        return _each_by_itself(points, directions, evidence, progress, parts)
    if view is not None:
        normals = by_view(points, directions, evidence, view)
        # Things with undersides on a floor were seen from below as well.
        if not view.overhung or np.mean(normals[:, 2] < -GRAZING) <= MOST_UNDERSIDES:
            return Orientation(normals, "viewpoint", view.why, view)
    return by_agreement(points, directions, evidence, progress)


def _if_hidden(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation | None:
    """Orient without the sensors if many points lie behind others from there, and far more neighbours agree without."""
    if evidence.sensors is None or share_hidden(points, directions, evidence.sensors) < MOST_HIDDEN:
        return None
    seen = by_view(points, directions, evidence, View.of_sensors(points, evidence.sensors))
    without = _by_best_method(points, directions, replace(evidence, sensors=None), progress)
    with_them, without_them = (
        1 - _core.orientation_consistency(points, normals, evidence.neighbors) for normals in (seen, without.normals)
    )
    return replace(without, sensors_refused=True) if without_them < MOST_DISAGREEMENT * with_them else None


def _each_by_itself(
    points: Vectors,
    directions: Vectors,
    evidence: SignEvidence,
    progress: PhaseCallback | None,
    parts: tuple[NDArray[np.int64], ...],
) -> Orientation:
    """Orient each of the parts, and what is left, as if it were all there is; told is how what is left was."""
    rest = rows_without(len(points), *parts)
    normals, found = directions.copy(), list[Orientation]()
    for rows in (*parts, rest):
        own = np.ascontiguousarray(points[rows])
        found.append(_by_best_method(own, directions[rows], evidence.of_rows(rows, own), progress))
        normals[rows] = found[-1].normals
    return replace(found[-1], normals=normals)


def _view(points: Vectors, directions: Vectors, evidence: SignEvidence) -> View | None:
    """Return from where all points were seen, if the file says so or it can be told."""
    if evidence.sensors is not None:
        return View.of_sensors(points, evidence.sensors)
    return single_view(points, directions, evidence.roughness, evidence.origin)
