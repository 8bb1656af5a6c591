# SPDX-License-Identifier: GPL-3.0-or-later
"""Random calls of the functions of the core, legal and broken; a case is known by its seed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from helpers.core_calls import CALLS
from helpers.fuzzing.cloud_shapes import SHAPES, Array, Random, spoilt
from helpers.fuzzing.topology import is_manifold
from numpy.typing import NDArray

from hdpea import _core

Integers = NDArray[np.int64]

OF_VERTICES, OF_POINTS, OF_FACES = (
    {"vertices", "coordinates"},
    {"points", "places", "queries", "seeds"},
    {"faces", "triangles"},
)
MADE_OF_MESHES = {
    "close_gaps",
    "fill_holes",
    "reach_points",
    "remesh_isotropically",
    "repair_self_intersections",
    "simplify_mesh",
    "simplify_within",
}
"""Functions that keep a manifold mesh manifold."""


class _World:
    """Arrays that fit one another: what a call takes is drawn from one cloud and one mesh."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.count = int(random.integers(1, 120))
        with np.errstate(all="ignore"):
            self.points = _places(random, self.count)
        self.count = len(self.points)
        self.width = int(random.integers(1, 20))

    def argument(self, name: str, given: Any) -> Any:
        """Return an argument of the name and kind of a legal one."""
        random, count = self.random, self.count
        if not isinstance(given, np.ndarray):
            return _scalar(random, given)
        if name in OF_FACES:
            return _faces(random, count)
        if name in {"neighbors", "sheet_neighbors"}:
            return self._neighbors()
        if name in OF_POINTS | OF_VERTICES and given.shape[1] == 3:
            return self.points
        return self._numbers(name, given)

    def _numbers(self, name: str, given: NDArray[Any]) -> NDArray[Any]:
        random, count = self.random, self.count
        if given.dtype == np.int32:
            return random.integers(0, 4, count).astype(np.int32)
        if name in {"normals", "direction1"}:
            return _unit(random.normal(size=(count, 3))) * random.choice([0, 1, 1, 1], (count, 1))
        return random.normal(size=(count, *given.shape[1:])) ** random.integers(1, 3)

    def _neighbors(self) -> Integers:
        if self.random.random() < 0.3 or not (abs(self.points) <= 1e150).all():
            return self.random.integers(-1, self.count, (self.count, self.width))
        return _core.nearest_neighbors(self.points, self.width)


def _places(random: Random, count: int) -> Array:
    points = SHAPES[random.integers(0, len(SHAPES))](random, count)
    points = spoilt(random, points) if random.random() < 0.1 else points
    return points if len(points) else np.zeros((1, 3))


def _unit(vectors: Array) -> Array:
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def _scalar(random: Random, given: Any) -> Any:
    if isinstance(given, int):
        return int(random.integers(0, 40))
    return float(random.choice([0, 1e-3, 0.3, 1, 100, 1e200, np.inf], p=[0.1, 0.1, 0.2, 0.2, 0.2, 0.1, 0.1]))


def _faces(random: Random, count: int) -> Integers:
    """Return faces of so many vertices: a strip, a closed fan, a tube, or nonsense."""
    index = np.arange(max(count - 2, 0))
    strip = np.stack([index, index + 1, index + 2], axis=1)
    strip[1::2] = strip[1::2, ::-1]
    around = np.arange(2, max(count, 2))
    after = np.where(around + 1 < count, around + 1, 2)
    kind = random.integers(0, 5)
    if kind == 0:
        return strip
    if kind == 1:
        return np.stack([0 * around, around, after], axis=1)
    if kind == 2:
        spindle = np.vstack([np.stack([0 * around, around, after], 1), np.stack([0 * around + 1, after, around], 1)])
        return spindle[random.random(len(spindle)) < random.choice([0.8, 1])]
    if kind == 3:
        side = int(count**0.5)
        corner = np.array(
            [row * side + column for row in range(side - 1) for column in range(side - 1)], dtype=np.int64
        )
        low = np.stack([corner, corner + 1, corner + side], axis=1)
        high = np.stack([corner + 1, corner + side + 1, corner + side], axis=1)
        grid = np.vstack([low, high])
        return grid[random.random(len(grid)) < random.choice([0.7, 0.95, 1])]
    return random.integers(0, count, (random.integers(0, 60), 3))


BREAKS: list[Callable[[Random, NDArray[Any]], Any]] = [
    lambda random, array: array[: random.integers(0, len(array) + 1)],
    lambda _, array: np.concatenate([array, array[:1]]),
    lambda _, array: array[::-1],
    lambda _, array: np.asfortranarray(array),
    lambda _, array: array.astype(np.float32 if array.dtype.kind == "f" else np.int16),
    lambda _, array: array.reshape(-1),
    lambda _, array: array[..., None],
    lambda random, array: _with(array, random, [np.nan, np.inf, 1e308, -1e308, 1e-310]),
    lambda random, array: _with(array, random, [-1, -2, len(array), len(array) - 1, 2**15, -(2**15)]),
]


def _with(array: NDArray[Any], random: Random, values: list[float]) -> NDArray[Any]:
    spoilt_array = array.copy()
    value = values[random.integers(0, len(values))]
    if array.size and (array.dtype.kind == "f" or (np.isfinite(value) and abs(value) <= np.iinfo(array.dtype).max)):
        spoilt_array.flat[random.integers(0, array.size)] = value
    return spoilt_array


def run(seed: int) -> str:
    """Call the function of a seed; return how it ended: ``result``, or the name of a documented error.

    Raises
    ------
    AssertionError
        If a mesh that was manifold is not any more. Any other exception is a fault as well.
    """
    random = np.random.default_rng([seed, 3])
    name = sorted(CALLS)[random.integers(0, len(CALLS))]
    call, legal = CALLS[name]
    world = _World(random)
    arguments = {each: world.argument(each, given) for each, given in legal.items()}
    arrays = [each for each, value in arguments.items() if isinstance(value, np.ndarray)]
    if random.random() < 0.4 and arrays:
        spoiled = arrays[random.integers(0, len(arrays))]
        arguments[spoiled] = BREAKS[random.integers(0, len(BREAKS))](random, arguments[spoiled])
    try:
        made = call(**arguments)
    except (_core.InvalidArgument, _core.CannotReconstruct, TypeError) as error:
        return type(error).__name__
    if name in MADE_OF_MESHES and made is not None and is_manifold(arguments["faces"]):
        assert is_manifold(made.faces), f"{name} made a mesh that is not manifold"
    return "result"
