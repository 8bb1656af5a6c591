# SPDX-License-Identifier: GPL-3.0-or-later
"""From a cloud to its curvature tensors: principal directions, curvatures, stretches and the metric."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hdpea.curvature.from_embedding import estimate_from_embedding
from hdpea.curvature.from_jets import estimate_from_jets
from hdpea.curvature.interpolation import interpolated_estimate
from hdpea.curvature.options import (
    MOST_NORMAL_NEIGHBORS,
    MOST_POINTS,
    NORMAL_NEIGHBORS_PER_NOISE,
    CurvatureOptions,
)
from hdpea.curvature.tensors import CurvatureTensors, Estimate
from hdpea.embedding import embed_surface
from hdpea.embedding.device import device_choices
from hdpea.errors import core_errors_translated
from hdpea.frontend.cleaning import surface_cloud
from hdpea.frontend.roughness import roughness_of
from hdpea.frontend.vantage import with_sensor_found
from hdpea.geometry.metric import Metric
from hdpea.geometry.tensors import metric_tensors
from hdpea.geometry.thinning import thinned
from hdpea.options import NormalOptions
from hdpea.options.choice import Choice
from hdpea.options.meshing import POINTS_PER_VERTEX
from hdpea.reading.cleaning import cleaned_cloud
from hdpea.reading.cloud import PointCloud
from hdpea.reading.objects import PointsLike
from hdpea.runtime.progress import ProgressCallback, tell
from hdpea.runtime.threads import limited_threads
from hdpea.surface.given_normals import judged_normals
from hdpea.surface.normals import ORIENTATION_NEIGHBORS
from hdpea.surface.preparation import prepare_surface
from hdpea.surface.surface import Surface


def estimate_curvature(
    points: PointsLike,
    normals: ArrayLike | None = None,
    options: CurvatureOptions | None = None,
    progress: ProgressCallback | None = None,
    sensors: ArrayLike | None = None,
) -> CurvatureTensors:
    """Estimate the curvature tensor at each point of a cloud.

    Parameters
    ----------
    points
        (n, 3) in any unit and frame; what is not finite, occurs twice or lies on no surface is dropped. Or a cloud as
        ``read_points`` returns it, which brings its normals and sensors.
    normals
        (n, 3) of any length and sign; estimated where missing, zero or not finite.
    options
        The method, its neighbours, and the options of the front end, normals and embedding.
    progress
        Called with the phases normals, embedding and curvature, and the fraction done; returning False cancels.
    sensors
        (n, 3), from where each point was seen; needed only to orient by viewpoint.

    Raises
    ------
    CannotReconstruct
        If the points are too few, equal or on a line.
    UsageError
        If the arrays are not of these shapes, or a viewpoint is asked for and there is none.
    UnreadableInput
        If the given normals, or their signs, are insisted on and unusable.
    Interrupted
        If `progress` cancelled.

    Examples
    --------
    >>> import numpy as np
    >>> angle, height = np.random.default_rng(0).random((2, 4000))
    >>> pipe = np.column_stack([np.cos(2 * np.pi * angle), np.sin(2 * np.pi * angle), 4 * height])
    >>> tensors = estimate_curvature(pipe)
    >>> bool(abs(tensors.direction2[:, 2]).min() > 0.9)  # along the pipe
    True
    """
    options = options or CurvatureOptions()
    with limited_threads(options.threads), core_errors_translated():
        found = surface_cloud(with_sensor_found(cleaned_cloud(points, normals, sensors)), options.cleaning)
        vertices, kept = _resolution(len(found.cloud.points), options.estimation.vertices)
        thin = found.cloud.at(kept)
        fitting, choices = _fitting_of_normals(thin, options)
        prepared = prepare_surface(thin, fitting, points_per_vertex=len(kept) / vertices, progress=progress)
        estimate, metric = _estimate(prepared.surface, vertices, options, progress)
        signed = options.estimation.method == "jet"
        cloud = found.on_surface
        if len(kept) < len(cloud.points):
            estimate = _at_all_points(cloud, prepared.surface, estimate, metric, signed)
        estimate = replace(estimate, choices=(*choices, *prepared.choices, *estimate.choices))
        notes = (*cloud.notes, *found.notes, *prepared.notes, *_notes(estimate))
        return _in_world(cloud, prepared.surface.frame.diagonal, estimate, metric, signed, notes)


def _resolution(points: int, vertices: int | None) -> tuple[int, NDArray[np.int64]]:
    """Return the vertices of a mesh that shows as much detail, and the rows of the points to estimate at."""
    vertices = vertices or max(min(points, MOST_POINTS) // POINTS_PER_VERTEX, 12)
    return vertices, thinned(points, max(MOST_POINTS, POINTS_PER_VERTEX * vertices))


def _fitting_of_normals(cloud: PointCloud, options: CurvatureOptions) -> tuple[NormalOptions, tuple[Choice, ...]]:
    """Fit normals to more neighbours the noisier the cloud is: curvature, their derivative, amplifies noise."""
    if options.normals.normal_neighbors is not None or options.estimation.method == "jet":
        return options.normals, ()
    centered = cloud.points - cloud.points.mean(axis=0)
    if _all_given(cloud, centered, options.normals):
        return options.normals, ()
    roughness = roughness_of(centered)
    count = min(round(NORMAL_NEIGHBORS_PER_NOISE * roughness.noise), MOST_NORMAL_NEIGHBORS)
    if count <= ORIENTATION_NEIGHBORS:
        return options.normals, ()
    choice = Choice("normal_neighbors", count, "points", str(roughness))
    return replace(options.normals, normal_neighbors=count), (choice,)


def _all_given(cloud: PointCloud, centered: NDArray[np.float64], options: NormalOptions) -> bool:
    """Return whether no normal will be estimated."""
    if cloud.normals is None or options.normals == "estimate" or not cloud.normals.any(axis=1).all():
        return False
    return bool(judged_normals(centered, cloud.normals, options).usable.all())


def _at_all_points(
    cloud: PointCloud, surface: Surface, estimate: Estimate, metric: Metric | None, signed: bool
) -> Estimate:
    everywhere = interpolated_estimate(
        surface.points_in_unit, estimate, metric, signed, surface.frame.to_unit(cloud.points)
    )
    why = f"others would show no finer curvature; interpolated at all {len(cloud.points):,}"
    choice = Choice("estimated_at", len(surface.points_in_unit), "points", why)
    return replace(everywhere, choices=(choice, *everywhere.choices))


def _estimate(
    surface: Surface, vertices: int, options: CurvatureOptions, progress: ProgressCallback | None
) -> tuple[Estimate, Metric | None]:
    neighbors = options.estimation.neighbors
    if options.estimation.method == "jet":
        tell(progress, "curvature", 0)
        metric = Metric(options.embedding.metric_scale, options.embedding.max_stretch)
        return estimate_from_jets(surface, metric, neighbors), metric
    embedded = embed_surface(surface, vertices, options.embedding, progress)
    tell(progress, "curvature", 0)
    estimate = estimate_from_embedding(surface, embedded, neighbors)
    if options.embedding.embedding == "learned":
        estimate = replace(estimate, choices=(*estimate.choices, *device_choices(options.embedding.device)))
    return estimate, embedded.metric


def _in_world(
    cloud: PointCloud,
    diagonal: float,
    estimate: Estimate,
    metric: Metric | None,
    signed: bool,
    notes: tuple[str, ...],
) -> CurvatureTensors:
    direction1 = np.where(estimate.determined[:, None], estimate.direction1, 0.0)
    low, high = (0.0, np.inf) if signed else metric.curvature_range if metric else (np.nan, np.nan)
    return CurvatureTensors(
        points=cloud.points,
        normals=estimate.normals,
        direction1=direction1,
        direction2=np.cross(estimate.normals, direction1),
        stretches=estimate.stretches,
        curvatures=estimate.curvatures / diagonal,
        metric=metric_tensors(estimate.normals, estimate.direction1, estimate.stretches),
        determined=estimate.determined,
        point_index=cloud.places(),
        signed=signed,
        curvature_range=(low / diagonal, high / diagonal),
        choices=estimate.choices,
        notes=notes,
    )


def _notes(estimate: Estimate) -> list[str]:
    unknown = int(np.isnan(estimate.stretches[:, 0]).sum())
    undetermined = int((~estimate.determined).sum()) - unknown
    told = {
        f"Points where the surface is flat or round, so that any direction is a principal one: {undetermined:,}.": (
            undetermined
        ),
        f"Points with too few neighbours to estimate curvature: {unknown:,}.": unknown,
    }
    return [note for note, count in told.items() if count]
