# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals: those of the file where they are usable, else estimated; always consistently oriented."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import UnreadableInput, core_errors_translated
from hdpea.frontend.roughness import Roughness, roughness_of
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import NormalOptions
from hdpea.options.choice import Choice
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.runtime.progress import ProgressCallback, of_phase, tell
from hdpea.surface.dense_parts import dense_parts
from hdpea.surface.given_normals import GivenNormals, judged_normals
from hdpea.surface.given_signs import GivenSigns, given_signs
from hdpea.surface.orientation import orient, require_signs
from hdpea.surface.signs import SignEvidence, Vectors
from hdpea.surface.single_view import View
from hdpea.surface.surface import NEIGHBORS, Surface, require_surface

ORIENTATION_NEIGHBORS = 16
"""Nearest points to which a point passes its orientation, and the fewest that an estimated normal is fitted to."""

NEIGHBORS_PER_NOISE, MOST_NEIGHBORS = 240, 80
"""Neighbours that an estimated normal is fitted to, for each spacing of noise, and the most.

The slope of a plane through n neighbours errs by 2 sqrt(pi) noise / (spacing n): so by a degree."""


@dataclass(frozen=True)
class OrientedSurface:
    """A surface, and where its normals are from.

    Attributes
    ----------
    roughness
        Of the points as given.
    estimated
        How many normals were estimated.
    signs
        What is thought of the signs of the given normals; None without any.
    method
        What gave the normals their signs, one of ``NormalOptions.orient`` but auto.
    refused
        How many of the given directions are no normals, so that these were estimated instead.
    choices
        What was chosen automatically.
    view
        From where the points were seen, where that decided the signs.
    sensors_refused
        Whether sensors were known, and cannot have seen the points.
    seams
        Whether strips that overlap and do not meet had opposite sides, and were turned.
    parts
        Rows of each part that was sampled far more densely than the scene it lies in.
    """

    surface: Surface
    roughness: Roughness
    estimated: int
    signs: GivenSigns | None
    method: str
    refused: int = 0
    choices: tuple[Choice, ...] = ()
    view: View | None = None
    sensors_refused: bool = False
    seams: bool = False
    parts: tuple[NDArray[np.int64], ...] = ()

    @property
    def from_one_place(self) -> bool:
        """Whether a single sensor saw all points, as far as is known."""
        return self.view is not None and self.view.from_one_place

    @property
    def doubled(self) -> bool:
        """Whether strips overlap that do not meet, as far as the view tells."""
        return self.view is not None and self.view.doubled

    @property
    def from_above(self) -> bool:
        """Whether that it is a height field, which the points alone say, decided the signs."""
        return self.view is not None and self.view.from_above

    @property
    def overhung(self) -> bool:
        """Whether trees and the like are above parts of that height field."""
        return self.view is not None and self.view.overhung

    @property
    def computed_sides(self) -> bool:
        """Whether nothing but the points decided which side is out, neither the file nor where they were seen from."""
        return self.method in {"wnnc", "mst"}


def oriented_surface(
    points_in_world: NDArray[np.float64],
    normals: NDArray[np.float64] | GivenNormals | None = None,
    options: NormalOptions | None = None,
    points_per_vertex: float = POINTS_PER_VERTEX,
    progress: ProgressCallback | None = None,
    sensors_in_world: NDArray[np.float64] | None = None,
) -> OrientedSurface:
    """Move a cloud to its unit frame and give it consistently oriented normals.

    Given normals keep their directions; their signs are kept only if neighbours agree about them, so a
    cloud whose normals point to both sides gives the same surface as one that is well oriented. Given directions that
    do not lie across the surface are not taken for normals. The options `orient` and `normals` overrule this.

    Parameters
    ----------
    points_in_world
        (n, 3) float64, finite and distinct.
    normals
        (n, 3) float64 of length 1, or 0 where unusable; or what was made of them already by ``judged_normals``.
    points_per_vertex
        Points for each vertex that would show what they do (``hdpea.options.Options.resolution_of``): with more,
        normals are fitted to more neighbours, so that noise averages out in a redundant cloud.
    sensors_in_world
        (n, 3) float64, from where each point was seen: decides the sides unless the normals' own signs do.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    UnreadableInput
        If the options demand the file's normals, or their signs, and they are unusable.
    UsageError
        If normals are to be turned to a viewpoint and there is none.
    """
    options = options or NormalOptions()
    given = normals if isinstance(normals, GivenNormals) else judged_normals(points_in_world, normals, options)
    require_signs(given.directions, sensors_in_world, options)
    frame = UnitFrame.around(points_in_world)
    points = frame.to_unit(points_in_world)
    require_surface(points)
    tell(progress, "normals", 0)
    with core_errors_translated():
        cloud = _Cloud.of(points, given.directions, given.usable)
        directions, choices = _directions(cloud, options, points_per_vertex)
        evidence = _evidence(cloud, frame, sensors_in_world, options)
        seen_from = _seen_from(frame, sensors_in_world, options) if options.orient == "viewpoint" else None
        parts = dense_parts(points, directions, cloud.neighbors)
        hears = of_phase(progress, "normals")
        orientation = orient(points, directions, evidence, options.orient, seen_from, hears, parts)
    if options.orient == "auto":
        choices += (Choice("orient", orientation.method, "", orientation.why),)
    tell(progress, "normals", 1)
    return OrientedSurface(
        Surface.of(frame, points, orientation.normals, cloud.neighbors),
        cloud.roughness,
        estimated=int((~cloud.usable).sum()),
        signs=evidence.signs,
        method=orientation.method,
        refused=given.refused,
        choices=choices,
        view=orientation.view,
        sensors_refused=orientation.sensors_refused,
        seams=orientation.seams,
        parts=parts,
    )


@dataclass(frozen=True)
class _Cloud:
    """Points (n, 3) in the unit frame, what was given of their normals and is usable, and what lies around them."""

    points: Vectors
    given: Vectors
    usable: NDArray[np.bool_]
    neighbors: NDArray[np.int64]
    roughness: Roughness

    @classmethod
    def of(cls, points: Vectors, given: Vectors, usable: NDArray[np.bool_]) -> _Cloud:
        """Find the neighbours of points and how rough these are."""
        return cls(points, given, usable, _core.nearest_neighbors(points, NEIGHBORS), roughness_of(points))


def _evidence(
    cloud: _Cloud, frame: UnitFrame, sensors_in_world: Vectors | None, options: NormalOptions
) -> SignEvidence:
    """Return what is known of the sides of a cloud before they are chosen."""
    nearest = np.ascontiguousarray(cloud.neighbors[:, :ORIENTATION_NEIGHBORS])
    # Where all normals are to be estimated, the signs of given ones count only if they are asked for.
    trusted = cloud.given if options.orient == "file" else np.where(cloud.usable[:, None], cloud.given, 0)
    signs = given_signs(cloud.points, trusted, nearest)
    origin, sensors = frame.to_unit(np.zeros(3)), _sensors(frame, sensors_in_world)
    return SignEvidence(trusted, ~cloud.usable, nearest, cloud.roughness, origin, sensors, signs)


def _sensors(frame: UnitFrame, sensors_in_world: Vectors | None) -> Vectors | None:
    """Return the sensor of each point (n, 3) in the unit frame, if all are known."""
    if sensors_in_world is None:
        return None
    with np.errstate(over="ignore"):
        in_unit = frame.to_unit(sensors_in_world)
    return in_unit if np.isfinite(in_unit).all() else None


def _seen_from(frame: UnitFrame, sensors_in_world: Vectors | None, options: NormalOptions) -> Vectors | None:
    """Return the viewpoint (3,), or the sensor of each point (n, 3), in the unit frame."""
    seen_from = sensors_in_world if options.viewpoint is None else options.viewpoint.as_array()
    if seen_from is None:
        return None
    with np.errstate(over="ignore"):
        in_unit = frame.to_unit(seen_from)
    if not np.isfinite(in_unit).all():
        raise UnreadableInput(
            "The viewpoint is too far from the points for double precision.", "Give it in the unit of the points."
        )
    return in_unit


def _directions(cloud: _Cloud, options: NormalOptions, points_per_vertex: float) -> tuple[Vectors, tuple[Choice, ...]]:
    """Return normals (n, 3) of any sign, the given ones where they are usable, and what was chosen for them."""
    points, usable, neighbors = cloud.points, cloud.usable, cloud.neighbors
    if usable.all():
        return cloud.given, ()
    count = options.normal_neighbors
    choices: tuple[Choice, ...] = ()
    if count is None:
        enough = min(round(NEIGHBORS_PER_NOISE * cloud.roughness.noise), MOST_NEIGHBORS)
        count = max(ORIENTATION_NEIGHBORS, min(round(2 * points_per_vertex), NEIGHBORS), enough)
        why = f"twice the points per particle, from {ORIENTATION_NEIGHBORS} to {NEIGHBORS}"
        if count == enough:
            why = str(cloud.roughness)
        choices = (Choice("normal_neighbors", count, "points", why),)
    fitted = neighbors if count <= NEIGHBORS else _core.nearest_neighbors(points, min(count, len(points) - 1))
    estimated = _core.estimate_normals(points, np.ascontiguousarray(fitted[:, :count]))
    return np.where(usable[:, None], cloud.given, estimated), choices
