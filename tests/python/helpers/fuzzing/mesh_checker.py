# SPDX-License-Identifier: GPL-3.0-or-later
"""What must hold of every mesh and its report, checked without any code of hdpea's."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from helpers.fuzzing.distances import to_triangles
from helpers.fuzzing.topology import boundary_loops, components_of, fans
from numpy.typing import NDArray

Array = NDArray[np.float64]
Faces = NDArray[np.int64]

FARTHEST = 1.0
"""How far from the box of the points a vertex may lie, in diagonals of a cube around it: so far apart heaps may be."""

ROUNDING = 1e-9
"""Of distances, in sides of the box; beside that of coordinates far from the origin."""

BUDGET = 0.01
"""Share of the vertices or faces asked for, or one of them, by which a mesh may differ without saying so."""


def faults(vertices: Array, faces: Faces, points: Array, report: dict[str, Any]) -> list[str]:
    """Return what is wrong with a mesh of distinct, finite points (n, 3), or with its report (as JSON); sentences."""
    shapes_right = vertices.ndim == faces.ndim == 2 and vertices.shape[1] == faces.shape[1] == 3
    if not shapes_right or len(faces) == 0:
        return [f"shapes are {vertices.shape} and {faces.shape}"]
    if faces.min() < 0 or faces.max() >= len(vertices):
        return ["a face has a vertex that does not exist"]
    if not np.isfinite(vertices).all():
        return ["a vertex is not finite"]
    topology = [*_topology(len(vertices), faces, report), *_wishes(len(vertices), len(faces), report)]
    return [*topology, *_geometry(vertices, faces, points, report)]


def _topology(count: int, faces: Faces, report: dict[str, Any]) -> Iterator[str]:
    told = report["mesh"]
    if (np.sort(faces, axis=1)[:, :-1] == np.sort(faces, axis=1)[:, 1:]).any():
        yield "a face repeats a vertex"
    if len(np.unique(np.sort(faces, axis=1), axis=0)) < len(faces):
        yield "two faces have the same corners"
    half_edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    if len(np.unique(half_edges, axis=0)) < len(half_edges):
        yield "two faces run through an edge in the same direction"
    edges, uses = np.unique(np.sort(half_edges, axis=1), axis=0, return_counts=True)
    if uses.max() > 2:
        yield "an edge has more than two faces"
    around = fans(count, faces)
    if (around != 1).any():
        yield f"{int((around > 1).sum())} vertices have several fans of faces, {int((around == 0).sum())} none"
    components = components_of(faces)
    loops = boundary_loops(faces)
    if told["vertices"] != count or told["faces"] != len(faces):
        yield "the report counts other vertices or faces"
    if told["closed"] != bool(uses.min() == 2) or told["boundary_loops"] != loops:
        yield f"the report says closed: {told['closed']}, {told['boundary_loops']} loops; there are {loops}"
    if told["components"] != components:
        yield f"the report counts {told['components']} components; there are {components}"
    genus = components - (count - len(edges) + len(faces) + loops) // 2
    if told["closed"] and told["genus"] != genus:
        yield f"the report says genus {told['genus']}; it is {genus}"


def _wishes(vertices: int, faces: int, report: dict[str, Any]) -> Iterator[str]:
    asked, missed = report["options"]["meshing"], " ".join(report["missed"])
    if asked["watertight"] and not report["mesh"]["closed"] and "watertight" not in missed:
        yield "it is not watertight, and the report does not say so"
    for wanted, count in ((asked["vertices"], vertices), (asked["faces"], faces)):
        if wanted is None or "were asked for, and the mesh has" in missed:
            continue
        # With an error, the number is the most there may be.
        off = max(count - wanted, 0 if asked["error"] else wanted - count)
        if off > max(1, BUDGET * wanted):
            yield f"{wanted} were wanted, it has {count}, and the report does not say so"


def _geometry(vertices: Array, faces: Faces, points: Array, report: dict[str, Any]) -> Iterator[str]:
    low, high = points.min(axis=0), points.max(axis=0)
    _, exponent = np.frexp((high - low).max())  # a scale at which squares are doubles

    def scaled(places: Array) -> Array:
        return np.ldexp(places - low, -exponent)

    rounding = ROUNDING + 8 * np.ldexp(np.spacing(abs(points).max()), -exponent)
    box, places = scaled(high), scaled(vertices)
    room = FARTHEST * np.sqrt(3) * box.max() + rounding
    if (places < -room).any() or (places > box + room).any():
        yield "a vertex lies far outside the box of the points"
    counts, told = report["counts"], report["distances"]["in_world_units"]
    dropped = counts["dropped_strays"] + counts["dropped_on_lines"]
    if counts["points"] + dropped != len(points):
        yield f"the report counts {counts['points']} points, {dropped} more dropped; there are {len(points)}"
    if dropped:
        return  # which ones, the report does not say
    to_mesh = to_triangles(scaled(points), places[faces])
    true = {
        "mean": to_mesh.mean(),
        "rms": (to_mesh**2).mean() ** 0.5,
        "percentile_95": np.percentile(to_mesh, 95),
        "max": to_mesh.max(),
    }
    for name, value in true.items():
        if not abs(np.ldexp(told[name], -exponent) - value) <= rounding * 2:
            yield f"the report's {name} distance is {told[name]}; it is {np.ldexp(value, exponent)}"
