# SPDX-License-Identifier: GPL-3.0-or-later
"""Embedding a surface in R^8, where its curvature metric is Euclidean.

Every method of embedding is one function ``(surface, vertices, options, progress) -> Embedded`` in a module of
its own, listed in ``EMBEDDERS``; the other stages see the coordinates only.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.embedding.device import device_choices
from hdpea.embedding.direct import embed_directly
from hdpea.embedding.embedded import Embedded
from hdpea.embedding.learned import embed_learned
from hdpea.errors import core_errors_translated
from hdpea.frontend.cleaning import surface_cloud
from hdpea.frontend.vantage import with_sensor_found
from hdpea.geometry.unit_frame import UnitFrame
from hdpea.options import EmbeddingOptions, Options
from hdpea.options.choice import Choice
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.reading.objects import PointsLike
from hdpea.runtime.progress import PhaseCallback, ProgressCallback, of_phase, tell
from hdpea.runtime.threads import limited_threads
from hdpea.surface.preparation import prepare_surface
from hdpea.surface.surface import Surface

Embedder = Callable[[Surface, int, EmbeddingOptions, PhaseCallback], Embedded]

EMBEDDERS: dict[str, Embedder] = {"direct": embed_directly, "learned": embed_learned}


@dataclass(frozen=True)
class Embedding:
    """A cloud and its coordinates in R^8.

    Attributes
    ----------
    points
        (n, 3) float64 in world units, in the order given: those that are finite and distinct, and stand for the
        surface (``hdpea.frontend``).
    normals
        (n, 3) float64, unit, consistently oriented.
    coordinates
        (n, 8) float64: the points in the unit frame, then psi.
    point_index
        (n,) int64, ascending: the row of each among the points that were given, or in the file.
    world_from_unit
        The unit frame.
    choices
        What was chosen automatically.
    notes
        Sentences for the user about the cloud.
    """

    points: NDArray[np.float64]
    normals: NDArray[np.float64]
    coordinates: NDArray[np.float64]
    point_index: NDArray[np.int64]
    world_from_unit: UnitFrame
    choices: tuple[Choice, ...] = ()
    notes: tuple[str, ...] = ()


def embed_surface(
    surface: Surface,
    vertices: int,
    options: EmbeddingOptions,
    progress: ProgressCallback | None = None,
    embedder: Embedder | None = None,
) -> Embedded:
    """Embed an oriented surface at the scale that a mesh with that many `vertices` can show.

    `embedder` replaces the one that the options name.
    """
    embedder = embedder or EMBEDDERS[options.embedding]
    tell(progress, "embedding", 0)
    with core_errors_translated():
        return embedder(surface, vertices, options, of_phase(progress, "embedding"))


def embed_points(
    points: PointsLike,
    normals: ArrayLike | None = None,
    options: Options | None = None,
    progress: ProgressCallback | None = None,
    sensors: ArrayLike | None = None,
) -> Embedding:
    """Embed a cloud in R^8.

    Parameters
    ----------
    points
        (n, 3) in world units; what is not finite, occurs twice, lies on no surface or crowds on scan lines is dropped.
        Or a cloud as ``read_points`` returns it, which brings its normals and sensors.
    normals
        (n, 3), of any length and sign; estimated where missing.
    sensors
        (n, 3), from where each point was seen; needed only to orient by viewpoint.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    UsageError
        If the arrays are not of these shapes, a viewpoint is asked for and there is none, or there is no such device.
    UnreadableInput
        If the given normals, or their signs, are insisted on and unusable.
    """
    options = options or Options()
    with limited_threads(options.threads):
        cloud = with_sensor_found(cleaned_cloud(points, normals, sensors))
        found = surface_cloud(cloud, options.cleaning)
        # The order that `reconstruct` embeds in, so that psi is the same: rounding may lead to another.
        cloud = found.in_order_of_space()
        vertices = options.resolution_of(found.points_shown)
        prepared = prepare_surface(
            cloud, options.normals, points_per_vertex=len(cloud.points) / vertices, progress=progress
        )
        surface = prepared.surface
        embedded = embed_surface(surface, vertices, options.embedding, progress)
    choices = (*prepared.choices, *embedded.choices)
    if options.embedding.embedding == "learned":
        choices += device_choices(options.embedding.device)
    notes = (*cloud.notes, *found.notes, *prepared.notes)
    index = cloud.places()
    rows = np.argsort(index)
    points_in_world, coordinates = cloud.points[rows], embedded.coordinates[rows]
    return Embedding(points_in_world, surface.normals[rows], coordinates, index[rows], surface.frame, choices, notes)
