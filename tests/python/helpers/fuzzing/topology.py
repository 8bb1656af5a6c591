# SPDX-License-Identifier: GPL-3.0-or-later
"""Fans, components and borders of a mesh, counted plainly."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

Faces = NDArray[np.int64]


def fans(count: int, faces: Faces) -> NDArray[np.int64]:
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


def components_of(faces: Faces) -> int:
    """Return how many pieces the faces are in, joined by edges."""
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


def boundary_loops(faces: Faces) -> int:
    """Return how many loops the edges of one face make."""
    half_edges = {edge for a, b, c in faces.tolist() for edge in ((a, b), (b, c), (c, a))}
    border = defaultdict(list)
    for a, b in half_edges:
        if (b, a) not in half_edges:
            border[a].append(b)
            border[b].append(a)
    return _pieces(border)


def is_manifold(faces: Faces) -> bool:
    """Return whether faces (f, 3) of any vertices are edge- and vertex-manifold and consistently oriented."""
    used, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 3)
    half_edges = np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    no_loop = (half_edges[:, 0] != half_edges[:, 1]).all()
    each_once = len(np.unique(half_edges, axis=0)) == len(half_edges)
    distinct = len(np.unique(np.sort(faces, axis=1), axis=0)) == len(faces)
    return bool(no_loop and each_once and distinct and (fans(len(used), faces) == 1).all())
