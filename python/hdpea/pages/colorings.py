# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and points with all that they can be coloured by."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea import _core
from hdpea.errors import core_errors_translated
from hdpea.geometry.mesh_curvature import largest_curvatures, triangle_stretches, vertex_means
from hdpea.geometry.thinning import thinned
from hdpea.geometry.triangles import area_vectors
from hdpea.pages.shapes import Coloring, MeshShape, OwnColors, PointShape
from hdpea.reading.attributes import split_colors

Rows = NDArray[np.float64]
Attributes = Mapping[str, NDArray[Any]]

MOST_POINTS = 200_000
"""Points of a cloud that a page shows: 2.4 MB of it."""

NEIGHBORS = 12
"""Nearest points that a normal is fitted to, for the shading alone."""

SATURATED = 98
"""Percentile of the values at which a ramp ends."""

EXPECTED = 10.0
"""Points that a face has by its area, from which on it is no chance if it has none: once in 22,000 such faces."""

DISTANCE, COLOR = "distance", "colour"
"""Names of colourings: distance between mesh and points, and the colours that the data have."""


def mesh_shape(
    name: str,
    vertices: Rows,
    faces: NDArray[np.int64],
    points: Rows | None = None,
    attributes: Attributes | None = None,
) -> MeshShape:
    """Return a mesh that can be coloured by curvature, by stretch, by its distance to points and by its attributes.

    Faces where points are missing, as where a hole was filled, have corners of their own, whose distance is unknown.

    Parameters
    ----------
    vertices, faces
        (v, 3) and (f, 3), f > 0, outward.
    points
        (n, 3), those that the mesh is to show.
    attributes
        Arrays (v,) or (v, c) by name, as files have them.
    """
    colorings: list[Coloring | OwnColors] = []
    bare = np.zeros(len(faces), dtype=bool)
    areas = np.linalg.norm(area_vectors(vertices, faces), axis=1)
    if points is not None and len(points):
        distances, bare = _distances_at_vertices(vertices, faces, areas, _rows(points, MOST_POINTS))
        colorings.append(distances)
    curvatures = largest_curvatures(vertices, faces)
    most = _percentile(abs(curvatures), SATURATED)
    note = "Principal curvature of largest magnitude, in 1 / unit of the file: red convex, blue concave."
    colorings.append(Coloring("curvature", curvatures, -most, most, note))
    logarithms = np.log(triangle_stretches(vertices, faces).clip(max=1e6))
    stretches = np.exp(vertex_means(logarithms, faces, areas, len(vertices)))
    note = "How many times longer than wide triangles are, against equilateral ones."
    colorings.append(Coloring("stretch", stretches, 1.0, max(_percentile(stretches, SATURATED), 1.5), note, True))
    colorings.extend(_of_attributes(attributes or {}, len(vertices)))
    return _with_own_corners(MeshShape(name, vertices, faces, tuple(colorings)), bare)


def point_shape(
    name: str,
    points: Rows,
    mesh: tuple[Rows, NDArray[np.int64]] | None = None,
    attributes: Attributes | None = None,
) -> PointShape:
    """Return up to ``MOST_POINTS`` of the points (n, 3), coloured by distance to a mesh and by their attributes."""
    rows = thinned(len(points), MOST_POINTS)
    points = np.ascontiguousarray(points[rows])
    colorings: list[Coloring | OwnColors] = []
    if mesh is not None:
        with core_errors_translated():
            distances = _core.closest_surface_points(*mesh, points).distance
        note = "Distance of each point to the mesh, in units of the file."
        colorings.append(Coloring(DISTANCE, distances, 0.0, _percentile(distances, SATURATED), note))
    chosen = {name: values[rows] for name, values in (attributes or {}).items()}
    colorings.extend(_of_attributes(chosen, len(points)))
    with core_errors_translated():
        size = float(np.ptp(points, axis=0).max(initial=0)) or 1.0
        scaled = np.ascontiguousarray((points - points[0]) / size)
        normals = _core.estimate_normals(scaled, _core.nearest_neighbors(scaled, NEIGHBORS))
    return PointShape(name, points, normals, tuple(colorings))


def _rows(points: Rows, most: int) -> Rows:
    return np.ascontiguousarray(points[thinned(len(points), most)])


def _with_own_corners(shape: MeshShape, chosen: NDArray[np.bool_]) -> MeshShape:
    """Return a mesh whose `chosen` faces (f,) share corners with no other; their distance is unknown."""
    corners, places = np.unique(shape.faces[chosen], return_inverse=True)
    count = len(shape.vertices)
    faces, rows = shape.faces.copy(), np.concatenate([np.arange(count), corners])
    faces[chosen] = count + places.reshape(-1, 3)
    colorings = [replace(each, values=each.values[rows]) for each in shape.colorings]
    for each in colorings:
        if each.name == DISTANCE:
            each.values[count:] = np.nan
    return MeshShape(shape.name, shape.vertices[rows], faces, tuple(colorings))


def _distances_at_vertices(
    vertices: Rows, faces: NDArray[np.int64], areas: Rows, points: Rows
) -> tuple[Coloring, NDArray[np.bool_]]:
    """Return the distances of points at the vertices, and which faces (f,) have none, but should by their `areas`."""
    with core_errors_translated():
        nearest = _core.closest_surface_points(vertices, faces, points)
    # A stray is far from any mesh, and would colour the faces that happen to be nearest to it, and end the ramp.
    high = _percentile(nearest.distance, SATURATED)
    scale = high or 1.0
    squares = np.bincount(nearest.face, (nearest.distance.clip(max=high) / scale) ** 2, len(faces))
    counts = np.bincount(nearest.face, minlength=len(faces)).astype(np.float64)
    means = np.divide(squares, counts, out=np.zeros(len(faces)), where=counts > 0)
    distances = scale * np.sqrt(vertex_means(means, faces, counts, len(vertices)))
    note = (
        "Distance of the points on a vertex's faces, root mean square, in units of the file, the farthest two of a "
        "hundred points taken for as far as the ramp goes; dark grey: there are none."
    )
    bare = (counts == 0) & (areas * len(points) > EXPECTED * areas.sum())
    return Coloring(DISTANCE, distances, 0.0, high, note), bare


def _of_attributes(attributes: Attributes, count: int) -> Iterator[Coloring | OwnColors]:
    columns = {name: np.asarray(values) for name, values in attributes.items() if len(values) == count}
    colors, others = split_colors(columns)
    if colors is not None:
        yield OwnColors(COLOR, np.rint(255 * np.nan_to_num(colors)).astype(np.uint8))
    for name, values in others.items():
        if values.ndim == 1 and values.dtype.kind in "iufb":
            numbers = values.astype(np.float64)
            low, high = _percentile(numbers, 100 - SATURATED), _percentile(numbers, SATURATED)
            yield Coloring(name, numbers, low, high, f"{name}, as in the file.")


def _percentile(values: Rows, percent: float) -> float:
    """Return the percentile of the finite values; 0 without any."""
    finite = values[np.isfinite(values)]
    return float(np.percentile(finite, percent)) if len(finite) else 0.0
