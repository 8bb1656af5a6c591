# SPDX-License-Identifier: GPL-3.0-or-later
"""Random clouds of every awkward kind, with random options; a case is known by its seed."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from helpers.fuzzing.cloud_options import settings_at_random
from helpers.fuzzing.cloud_shapes import SHAPES, Array, Random, spoilt
from helpers.fuzzing.mesh_checker import faults
from numpy.typing import ArrayLike

from hdpea import reconstruct
from hdpea.errors import CannotReconstruct, UnreadableInput, UsageError
from hdpea.options import Options
from hdpea.options.settings import filled
from hdpea.reading.copies import first_copies


@dataclass(frozen=True)
class Case:
    """Arguments of ``reconstruct``: points, normals and sensors of any type, and settings by name."""

    points: ArrayLike
    normals: ArrayLike | None
    sensors: ArrayLike | None
    settings: dict[str, Any]

    @property
    def finite_points(self) -> Array:
        """The points that count, (n, 3): finite and distinct by more than rounding."""
        points = np.asarray(self.points, dtype=np.float64)
        distinct = np.unique(points[np.isfinite(points).all(axis=1)], axis=0)
        return distinct[first_copies(distinct)]


def cloud(seed: int, most: int = 300) -> Case:
    """Return the case of a seed, of about `most` points at most."""
    random = np.random.default_rng([seed, 1])
    count = int(random.integers(16, most) if random.random() < 0.95 else random.integers(0, 20))
    with np.errstate(all="ignore"):
        points = SHAPES[random.integers(0, len(SHAPES))](random, count)
        points = spoilt(random, points) if count else points
        normals = _normals(random, points)
        settings = settings_at_random(random, len(points))
        sensors = random.normal(size=points.shape) * 3 if settings.get("orient") == "viewpoint" else None
        given = TYPES[random.integers(0, len(TYPES))](points) if random.random() < 0.3 else points
        return Case(given, normals, sensors, settings)


def _normals(random: Random, points: Array) -> Array | None:
    kind = random.integers(0, 8)
    outwards = points - points.mean(axis=0) if len(points) else points
    match kind:
        case 0:
            return outwards
        case 1:
            return outwards * random.choice([-1.0, 1.0], (len(points), 1))
        case 2:
            return random.normal(size=points.shape)
        case 3:
            return np.where(random.random((len(points), 1)) < 0.4, random.choice([0.0, np.nan, np.inf]), outwards)
        case 4:
            return outwards * 10.0 ** random.uniform(-300, 300)
    return None


TYPES: list[Callable[[Array], ArrayLike]] = [
    lambda points: points.astype(np.float32),
    lambda points: np.nan_to_num(points).clip(-1e9, 1e9).astype(np.int64),
    lambda points: points.astype(">f8"),
    lambda points: points.tolist() or points,
    np.asfortranarray,
    lambda points: np.repeat(points, 2, axis=0)[::2],
    lambda points: points.astype(np.longdouble),
]
"""Other types of number, orders of bytes and layouts of the same points."""


def run(seed: int, most: int = 300) -> str:
    """Reconstruct the cloud of a seed; return how it ended: ``mesh``, or the name of a documented error.

    Raises
    ------
    AssertionError
        If a mesh or its report is wrong. Any other exception is a fault as well, and so is a warning, or an error
        that is no sentence.
    """
    case = cloud(seed, most)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            options = filled(Options, case.settings)
            made = reconstruct(case.points, case.normals, options, sensors=case.sensors)
        except (UsageError, UnreadableInput, CannotReconstruct) as error:
            if not error.message.endswith("."):
                raise
            return type(error).__name__
    report = json.loads(json.dumps(made.report.as_dict(), default=lambda number: number.item()))
    found = faults(made.vertices, made.faces, case.finite_points, report)
    assert not found, "; ".join(found)
    return "mesh, missed" if made.report.missed else "mesh"
