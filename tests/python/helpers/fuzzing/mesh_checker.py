# SPDX-License-Identifier: GPL-3.0-or-later
"""What must hold of every mesh and its report, checked without any code of hdpea's."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Faces = NDArray[np.int64]

FARTHEST = 1.0
"""How far from the box of the points a vertex may lie, in diagonals of a cube around it: so far apart heaps may be."""


def faults(vertices: Array, faces: Faces, points: Array, report: dict[str, Any]) -> list[str]:
    """Return what is wrong with a mesh of distinct, finite points (n, 3), or with its report (as JSON); sentences."""
    shapes_right = vertices.ndim == faces.ndim == 2 and vertices.shape[1] == faces.shape[1] == 3
    if not shapes_right or len(faces) == 0:
        return [f"shapes are {vertices.shape} and {faces.shape}"]
    if faces.min() < 0 or faces.max() >= len(vertices):
        return ["a face has a vertex that does not exist"]
    return [*_geometry(vertices, points), *_topology(len(vertices), faces, report), *_distances(points, report)]


def _geometry(vertices: Array, points: Array) -> Iterator[str]:
    if not np.isfinite(vertices).all():
        yield "a vertex is not finite"
        return
    low, high = points.min(axis=0), points.max(axis=0)
    room = FARTHEST * np.sqrt(3) * (high - low).max()
    if (vertices < low - room).any() or (vertices > high + room).any():
        yield "a vertex lies far outside the box of the points"


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
    fans = _fans(count, faces)
    if (fans != 1).any():
        yield f"{int((fans > 1).sum())} vertices have several fans of faces, {int((fans == 0).sum())} none"
    components = _components(faces)
    loops = _boundary_loops(faces)
    if told["vertices"] != count or told["faces"] != len(faces):
        yield "the report counts other vertices or faces"
    if told["closed"] != bool(uses.min() == 2) or told["boundary_loops"] != loops:
        yield f"the report says closed: {told['closed']}, {told['boundary_loops']} loops; there are {loops}"
    if told["components"] != components:
        yield f"the report counts {told['components']} components; there are {components}"
    genus = components - (count - len(edges) + len(faces) + loops) // 2
    if told["closed"] and told["genus"] != genus:
        yield f"the report says genus {told['genus']}; it is {genus}"
    if report["options"]["meshing"]["watertight"] and not (told["closed"] or report["missed"]):
        yield "it is not watertight, and the report does not say so"


def _fans(count: int, faces: Faces) -> NDArray[np.int64]:
    """Return how many fans of edge-connected faces each vertex has."""
    links: list[dict[int, list[int]]] = [defaultdict(list) for _ in range(count)]
    for a, b, c in faces.tolist():
        for v, one, other in ((a, b, c), (b, c, a), (c, a, b)):
            links[v][one].append(other)
            links[v][other].append(one)
    return np.array([_pieces(link) for link in links])


def _pieces(graph: dict[int, list[int]]) -> int:
    pieces, seen = 0, set[int]()
    for start in graph:
        if start in seen:
            continue
        pieces += 1
        waiting = [start]
        while waiting:
            node = waiting.pop()
            if node not in seen:
                seen.add(node)
                waiting.extend(graph[node])
    return pieces


def _components(faces: Faces) -> int:
    of_edge, graph = dict[tuple[int, int], int](), dict[int, list[int]]()
    for face, (a, b, c) in enumerate(faces.tolist()):
        graph[face] = []
        for edge in ((a, b), (b, c), (c, a)):
            key = (min(edge), max(edge))
            other = of_edge.setdefault(key, face)
            if other != face:
                graph[face].append(other)
                graph[other].append(face)
    return _pieces(graph)


def _boundary_loops(faces: Faces) -> int:
    half_edges = {edge for a, b, c in faces.tolist() for edge in ((a, b), (b, c), (c, a))}
    border = defaultdict(list)
    for a, b in half_edges:
        if (b, a) not in half_edges:
            border[a].append(b)
            border[b].append(a)
    return _pieces(border)


def _distances(points: Array, report: dict[str, Any]) -> Iterator[str]:
    told = report["distances"]["in_world_units"]
    if not all(np.isfinite(value) and value >= 0 for value in told.values()):
        yield "the report has a distance that is no number"
    elif not told["mean"] <= told["rms"] * (1 + 1e-9) <= told["max"] * (1 + 2e-9):
        yield "the mean, rms and largest distance are not in order"
    if report["counts"]["points"] != len(points):
        yield f"the report counts {report['counts']['points']} points; there are {len(points)}"
