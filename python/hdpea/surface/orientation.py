# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of the surface is out: methods that find the signs of normals whose directions are known."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import UnreadableInput, UsageError
from hdpea.frontend.roughness import Roughness
from hdpea.geometry.thinning import farthest_rows, rows_without
from hdpea.options import NormalOptions
from hdpea.runtime.progress import PhaseCallback
from hdpea.surface.given_signs import GivenSigns
from hdpea.surface.single_view import GRAZING, View, single_view

Vectors = NDArray[np.float64]

AGREEING_COSINE = 0.5
"""Least |cosine| with the winding number's normal at which a direction counts as the same normal: 60 degrees."""

DEVIATIONS_WIDE = 1.6
"""Smoothing width of the winding number for each standard deviation of the noise.

A smaller width resolves single points, and beside holes half of a thick shell of noise turns inwards (boot, noise of
0.5 % of the diagonal); a larger one merges the two sides of a wall (goblet_top, as much noise, from 2.0 on)."""

DECIDING = 50_000
"""Most points that the sides are decided on; of more, the others follow the nearest of these.

They are farthest points, and lie as evenly and twice as near to each other as the particles of most meshes."""

FOLLOWED = 4
"""Nearest deciding points of which the one whose plane is most nearly a point's own is followed: so a wall has two."""

MOST_OF_WALLS = 0.15
"""Largest deviation, in spacings, that counts for the width where it is not noise: walls must keep two sides."""


FAVOURED, CHANCE = 1.5, 0.0003
"""How many times the disagreement of the spanning tree that of the winding number may be, and what is added to it.

A tree joins those that agree most, so that a whole part may be on the wrong side and few neighbours disagree. Rings
and views of twelve training meshes have 2.1 % of their points on the wrong side instead of 3.0 %; 73 scans with holes
of 25 others 4.7 % either way."""


@dataclass(frozen=True)
class SignEvidence:
    """What is known of the signs of normals (n, 3) besides their directions.

    Attributes
    ----------
    given
        (n, 3) float64: normals whose signs may be used, of length 1, or 0 where there is none.
    estimated
        (n,) bool: which directions are estimates, not given.
    neighbors
        (n, k) int64: nearest other points, -1 pads.
    roughness
        Of the points.
    origin
        (3,) float64: that of the file, where a camera may have been.
    sensors
        (n, 3) float64, what saw each point; None if the file does not say.
    signs
        What is thought of the signs of the given normals; None without any.
    """

    given: Vectors
    estimated: NDArray[np.bool_]
    neighbors: NDArray[np.int64]
    roughness: Roughness
    origin: Vectors
    sensors: Vectors | None = None
    signs: GivenSigns | None = None


@dataclass(frozen=True)
class Orientation:
    """Oriented unit normals (n, 3), and how they became so.

    Attributes
    ----------
    normals
        (n, 3) float64.
    method
        One of ``NormalOptions.orient``.
    why
        Why this method was chosen.
    from_one_place
        Whether a single sensor saw all points, as far as is known.
    doubled
        Whether strips overlap that do not meet, as far as the view tells.
    """

    normals: Vectors
    method: str
    why: str = ""
    from_one_place: bool = False
    doubled: bool = False


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
    seen_from: Vectors | None = None,
    progress: PhaseCallback | None = None,
    parts: tuple[NDArray[np.int64], ...] = (),
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
    return Orientation(by_spanning_tree(points, directions, evidence), method)


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
    view = _view(points, directions, evidence)
    # A ball on the ground may be so small a share of the points that all seem to be a height field.
    if parts and not (view is not None and (view.from_one_place or evidence.sensors is not None)):
        return _each_by_itself(points, directions, evidence, progress, parts)
    if view is not None:
        normals = by_view(points, directions, evidence, view)
        return Orientation(normals, "viewpoint", view.why, view.from_one_place, view.doubled)
    if len(points) > DECIDING:
        return _as_deciding_points(points, directions, evidence, progress)
    return _by_agreement(points, directions, evidence, progress)


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
        found.append(_by_best_method(own, directions[rows], _evidence_of(evidence, rows, own), progress))
        normals[rows] = found[-1].normals
    return replace(found[-1], normals=normals)


def _evidence_of(evidence: SignEvidence, rows: NDArray[np.int64], points: Vectors) -> SignEvidence:
    """Return what is known of the signs of the rows (m,) alone, whose points are (m, 3)."""
    return replace(
        evidence,
        given=evidence.given[rows],
        estimated=evidence.estimated[rows],
        neighbors=_core.nearest_neighbors(points, evidence.neighbors.shape[1]),
        sensors=None if evidence.sensors is None else evidence.sensors[rows],
    )


def _view(points: Vectors, directions: Vectors, evidence: SignEvidence) -> View | None:
    """Return from where all points were seen, if the file says so or it can be told."""
    if evidence.sensors is not None:
        return View.of_sensors(points, evidence.sensors)
    return single_view(points, directions, evidence.roughness, evidence.origin)


def _by_agreement(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation:
    candidates = {
        "wnnc": by_winding_number(points, directions, evidence, progress),
        "mst": by_spanning_tree(points, directions, evidence),
    }
    agreed = {
        method: _core.orientation_consistency(points, normals, evidence.neighbors)
        for method, normals in candidates.items()
    }
    # Noise and thin walls mislead the spanning tree, large openings the winding number: then neighbours disagree.
    most = FAVOURED * (1 - agreed["mst"]) + CHANCE
    best, other = ("wnnc", "mst") if 1 - agreed["wnnc"] <= most else ("mst", "wnnc")
    why = f"{agreed[best]:.2%} of neighbours agree on the side, by {other} {agreed[other]:.2%}"
    return Orientation(candidates[best], best, why)


def _as_deciding_points(
    points: Vectors, directions: Vectors, evidence: SignEvidence, progress: PhaseCallback | None
) -> Orientation:
    """Orient the points that lie farthest from each other, and all others as these are."""
    deciding = np.sort(farthest_rows(points, DECIDING))
    few = np.ascontiguousarray(points[deciding])
    # Their spacing is wider than that of all, so that in spacings they are less rough.
    thinner = Roughness(
        evidence.roughness.deviation * float(np.sqrt(DECIDING / len(points))), evidence.roughness.like_noise
    )
    known = replace(_evidence_of(evidence, deciding, few), roughness=thinner)
    decided = _by_agreement(few, np.ascontiguousarray(directions[deciding]), known, progress)
    return replace(decided, normals=_followed(points, directions, few, decided.normals))


def _followed(points: Vectors, directions: Vectors, deciding: Vectors, normals: Vectors) -> Vectors:
    """Turn the directions (n, 3) as the normals (m, 3) of the deciding points (m, 3) near them that are most alike."""
    nearest = _core.nearest_neighbors(deciding, points, FOLLOWED)
    alike = np.einsum("nc,nkc->nk", directions, normals[nearest])
    best = abs(alike).argmax(axis=1)
    return np.where(alike[np.arange(len(points)), best] < 0, -1, 1)[:, None] * directions


def by_file(points: Vectors, directions: Vectors, evidence: SignEvidence) -> Vectors:
    """Take the signs of the given normals, and where there is none, that of the nearest point that has one."""
    signed = turned(directions, evidence.given)
    usable = np.asarray(evidence.given.any(axis=1))
    if usable.all():
        return signed
    oriented = by_spanning_tree(points, directions, evidence)
    kept = cosines(oriented, signed)[usable] >= 0
    nearest_usable = _core.nearest_neighbors(points[usable], points[~usable], 1)[:, 0]
    signed[~usable] = np.where(kept[nearest_usable], 1, -1)[:, None] * oriented[~usable]
    return signed


def by_view(points: Vectors, directions: Vectors, evidence: SignEvidence, view: View) -> Vectors:
    """Turn normals to what saw the points; those seen at a grazing angle, where noise decides, follow the others."""
    signed = turned(directions, view.towards)
    known = np.asarray(cosines(signed, view.towards) > GRAZING)
    return signed if known.all() else _core.orient_normals(points, signed, evidence.neighbors, known)


def by_spanning_tree(points: Vectors, directions: Vectors, evidence: SignEvidence) -> Vectors:
    """Propagate the sign from neighbour to neighbour, along the edges whose ends are most nearly parallel."""
    return _core.orient_normals(points, directions, evidence.neighbors)


def by_winding_number(
    points: Vectors,
    directions: Vectors,
    evidence: SignEvidence,
    progress: PhaseCallback | None = None,
) -> Vectors:
    """Take the signs of the winding number's normals; estimates far from these are replaced by them."""
    options, roughness = _core.WnncOptions(), evidence.roughness
    noise = roughness.deviation if roughness.like_noise else min(roughness.deviation, MOST_OF_WALLS)
    options.spacings_wide += DEVIATIONS_WIDE * noise
    winding = _core.wnnc_normals(points, options, progress)
    agreeing = abs(cosines(directions, winding)) >= AGREEING_COSINE
    signed = turned(directions, winding)
    # An estimate far off was fitted across an edge or a thin wall, which the winding number tells apart.
    replaced = evidence.estimated & ~agreeing
    signed[replaced] = winding[replaced]
    # Beside large holes of the cloud it may be wrong about half a face: so faces vote.
    return _core.agree_on_signs(points, signed, evidence.neighbors)


def turned(directions: Vectors, towards: Vectors) -> Vectors:
    """Return the directions (n, 3), those flipped that point away from the vectors `towards` (n, 3)."""
    return np.where(cosines(directions, towards) < 0, -1, 1)[:, None] * directions


def cosines(a: Vectors, b: Vectors) -> Vectors:
    """Return the scalar products of the rows of two arrays (n, 3)."""
    return np.asarray(np.einsum("nc,nc->n", a, b))
