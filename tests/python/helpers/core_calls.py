# SPDX-License-Identifier: GPL-3.0-or-later
"""A legal call of each function of the core, and the same call with each of its arrays broken in every way."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from helpers import clouds
from numpy.typing import NDArray

from hdpea import _core

Arguments = dict[str, Any]

COUNT = 60
POINTS, NORMALS = clouds.sphere(COUNT)
NEIGHBORS = _core.nearest_neighbors(POINTS, 12)
VERTICES = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
FACES = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
BASES = _core.tangent_bases_across(NORMALS)
RADII = np.full(COUNT, 0.8)
CREASES = _core.find_creases(*clouds.box(2000))
CANDIDATES = _core.restricted_voronoi_candidates(POINTS, BASES, NEIGHBORS, RADII)


def _cloud() -> Arguments:
    return {"points": POINTS, "normals": NORMALS, "neighbors": NEIGHBORS}


def _mesh() -> Arguments:
    return {"vertices": VERTICES, "faces": FACES}


def _extract(triangles: NDArray[np.int64], counts: NDArray[np.int32], **others: Any) -> None:
    candidates = _core.Candidates(triangles, counts, np.ones(COUNT))
    _core.extract_manifold(candidates=candidates, options=_core.ExtractionOptions(), **others)


def _solve(principal: NDArray[np.float64], direction1: NDArray[np.float64], **others: Any) -> None:
    curvature = _core.estimate_curvature(POINTS, NORMALS, NEIGHBORS, 0.5)
    curvature.principal, curvature.direction1 = principal, direction1
    _core.solve_embedding(curvature=curvature, options=_core.EmbeddingOptions(), **others)


def _remesh(vertices: NDArray[np.float64], faces: NDArray[np.int64]) -> None:
    options = _core.RemeshingOptions()
    options.edge_length = 0.7
    _core.remesh_isotropically(vertices, faces, options)


def _simplified() -> Arguments:
    return _mesh() | {"coordinates": VERTICES, "points": POINTS, "normals": NORMALS}


def _simplify(**arrays: Any) -> None:
    _core.simplify_mesh(budget=_core.MeshBudget(), **arrays)


CALLS: dict[str, tuple[Callable[..., Any], Arguments]] = {
    "agree_on_signs": (_core.agree_on_signs, _cloud()),
    "align_to_creases": (lambda **arrays: _core.align_to_creases(creases=CREASES, **arrays), _mesh()),
    "blended_normals": (_core.blended_normals, {"normals": NORMALS, "sheet_neighbors": NEIGHBORS}),
    "check_mesh": (_core.check_mesh, _mesh()),
    "closest_surface_points": (_core.closest_surface_points, _mesh() | {"queries": POINTS}),
    "count_self_intersections": (_core.count_self_intersections, _mesh()),
    "crease_edges": (lambda **arrays: _core.crease_edges(creases=CREASES, **arrays), _mesh()),
    "estimate_curvature": (_core.estimate_curvature, _cloud() | {"radius": 0.5}),
    "estimate_normals": (_core.estimate_normals, {"points": POINTS, "neighbors": NEIGHBORS}),
    "extract_manifold": (
        _extract,
        {
            "coordinates": POINTS,
            "normals": NORMALS,
            "disk_radii": RADII,
            "triangles": CANDIDATES.triangles,
            "counts": CANDIDATES.counts,
        },
    ),
    "close_gaps": (_core.close_gaps, _mesh() | {"normals": np.zeros_like(VERTICES), "max_size": 1.0}),
    "face_outwards": (_core.face_outwards, _mesh()),
    "farthest_point_sampling": (_core.farthest_point_sampling, {"points": POINTS, "count": 5}),
    "fill_holes": (_core.fill_holes, {"vertices": VERTICES, "faces": FACES[:3], "max_size": np.inf}),
    "find_creases": (_core.find_creases, {"points": POINTS, "normals": NORMALS}),
    "fit_jets": (_core.fit_jets, _cloud()),
    "moving_least_squares": (_core.moving_least_squares, _cloud() | {"places": POINTS}),
    "nearest_neighbors": (_core.nearest_neighbors, {"points": POINTS, "queries": VERTICES, "k": 5}),
    "orient_normals": (_core.orient_normals, _cloud()),
    "orientation_consistency": (_core.orientation_consistency, _cloud()),
    "reach_points": (_core.reach_points, _mesh() | {"points": POINTS, "normals": NORMALS, "far": 0.1}),
    "refine_vertices": (
        lambda **arrays: _core.refine_vertices(options=_core.RefinementOptions(), **arrays),
        _mesh() | {"points": POINTS, "normals": NORMALS},
    ),
    "remesh_anisotropically": (
        _core.remesh_anisotropically,
        _mesh()
        | {
            "coordinates": VERTICES,
            "cloud": POINTS,
            "bases": BASES,
            "normals": NORMALS,
        },
    ),
    "remesh_isotropically": (_remesh, _mesh()),
    "repair_self_intersections": (_core.repair_self_intersections, _mesh() | {"points": POINTS, "farthest": 0.1}),
    "restricted_voronoi_candidates": (
        _core.restricted_voronoi_candidates,
        {"seeds": POINTS, "bases": BASES, "neighbors": NEIGHBORS, "radii": RADII},
    ),
    "set_thread_limit": (_core.set_thread_limit, {"count": 1}),
    "sheet_neighbors": (_core.sheet_neighbors, _cloud()),
    "simplify_mesh": (_simplify, _simplified()),
    "simplify_within": (_core.simplify_within, _simplified() | {"radii": RADII, "error": 0.5}),
    "solve_embedding": (
        _solve,
        {
            "points": POINTS,
            "normals": NORMALS,
            "principal": np.ones((COUNT, 2)),
            "direction1": BASES[:, :3].copy(),
            "triangles": CANDIDATES.triangles,
            "weights": CANDIDATES.counts / 3,
            "initial": np.ones((COUNT, 5)),
        },
    ),
    "tangent_bases": (
        _core.tangent_bases,
        {"coordinates": np.hstack([POINTS, POINTS]), "normals": NORMALS, "neighbors": NEIGHBORS},
    ),
    "tangent_bases_across": (_core.tangent_bases_across, {"normals": NORMALS}),
    "turn_at_seams": (_core.turn_at_seams, _cloud()),
    "wnnc_normals": (lambda points: _core.wnnc_normals(points, _core.WnncOptions()), {"points": POINTS}),
}


def broken(value: Any) -> Iterator[tuple[Any, bool]]:
    """Yield broken versions of an argument, and whether each must be refused."""
    if not isinstance(value, np.ndarray):
        yield -2 if isinstance(value, int) else -2.0, True
        return
    yield value[:0], False
    yield value[:, :0] if value.ndim == 2 else value[:0], False
    yield value[:, ::-1] if value.ndim == 2 else value[::-1], False  # not contiguous
    yield np.zeros_like(value), False
    yield np.random.default_rng(0).permuted(value.ravel()).reshape(value.shape), False
    yield np.zeros((3, 3, 3)), True
    if value.dtype.kind == "f":
        for scale in (1e-320, 1e-160, 1e100, 1e160, 1e300):
            yield value * scale, False
    for bad in (np.nan, np.inf) if value.dtype.kind == "f" else (-2, len(POINTS), 10**6, 2**40):
        if value.dtype.kind == "i" and bad > np.iinfo(value.dtype).max:
            continue
        spoilt = value.copy()
        spoilt.flat[-1] = bad
        yield spoilt, True


def resized(value: Any) -> Iterator[Any]:
    """Yield arrays of another number of rows."""
    if isinstance(value, np.ndarray):
        yield value[:-1]
        yield np.concatenate([value, value[:1]])


def refused(call: Callable[..., Any], arguments: Arguments) -> bool:
    """Return whether the core refuses the arguments; any other error than its own and nanobind's passes on."""
    try:
        call(**arguments)
    except (_core.InvalidArgument, _core.CannotReconstruct, TypeError):
        return True
    return False


def main(name: str) -> int:
    """Call a function legally, then with each argument broken in turn; return how many calls were refused."""
    call, arguments = CALLS[name]
    if refused(call, arguments):
        raise AssertionError(f"the legal call of {name} is refused")
    count = 0
    for each, value in arguments.items():
        for spoilt, must_refuse in broken(value):
            was_refused = refused(call, arguments | {each: spoilt})
            if must_refuse and not was_refused:
                raise AssertionError(f"{name} accepts a broken {each}: {spoilt!r}")
            count += was_refused
        for other in resized(value):
            refused(call, arguments | {each: other})
    empty = {each: value[:0] if isinstance(value, np.ndarray) else value for each, value in arguments.items()}
    refused(call, empty)
    return count


if __name__ == "__main__":
    sys.stdout.write(str(main(sys.argv[1])))
