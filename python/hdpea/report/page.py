# SPDX-License-Identifier: GPL-3.0-or-later
"""A reconstruction as a page: the mesh, the points it was made of, and what the report says."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hdpea.pages.colorings import COLOR, mesh_shape, point_shape
from hdpea.pages.page import write_page
from hdpea.pages.shapes import Shape
from hdpea.pictures.camera import mean_sight
from hdpea.reading.cloud import PointCloud
from hdpea.report.report import Report


def write_result_page(
    path: Path,
    title: str,
    mesh: tuple[NDArray[np.float64], NDArray[np.int64]],
    cloud: PointCloud,
    report: Report,
    attributes: Mapping[str, NDArray[Any]] | None = None,
    up: str | None = None,
) -> None:
    """Write a page of a reconstruction, to be turned in any browser, offline.

    Parameters
    ----------
    path
        An HTML file, replaced only once the new one is complete.
    mesh
        Vertices (v, 3) and faces (f, 3), in world units.
    cloud
        As it was read; of many points, some are shown.
    attributes
        Of the vertices, arrays (v,) or (v, c) by name.
    up
        The axis that is up; default: the one that the shape shows.

    Raises
    ------
    UsageError
        If the file cannot be written.
    """
    shapes: list[Shape] = [
        mesh_shape("mesh", *mesh, cloud.points, attributes),
        point_shape("points", cloud.points, mesh, cloud.attributes),
    ]
    sight = mean_sight(cloud.points, cloud.sensors())
    write_page(path, title, shapes, list(_figures(report)), coloring=COLOR, sight=sight, up=up)


def _figures(report: Report) -> Iterator[tuple[str, str]]:
    mesh, distances, total = report.mesh, report.distances, report.clock.total()
    yield "vertices", f"{mesh.vertices:,}"
    yield "faces", f"{mesh.faces:,}"
    yield "pieces", f"{mesh.components:,}"
    yield "open borders", f"{mesh.boundary_loops:,}" if mesh.boundary_loops else "none: closed"
    yield "faces that cross", f"{mesh.self_intersections:,}"
    yield "points apart", f"{distances.spacing:.3g}"
    yield "points to mesh, rms", f"{distances.rms:.3g}"
    yield "95 % within", f"{distances.percentile_95:.3g}"
    yield "at most", f"{distances.max:.3g}"
    yield "took", f"{total.seconds:.1f} s, {total.peak_bytes / 1e9:.2f} GB"
    yield from (("", each) for each in report.missed)
