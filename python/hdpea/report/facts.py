# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured of a mesh: what it is, and how far it is from the points."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class MeshFacts:
    """What kind of surface the mesh is; ``genus`` is None unless it is closed (and summed over components)."""

    vertices: int
    faces: int
    manifold: bool
    closed: bool
    components: int
    boundary_loops: int
    genus: int | None
    self_intersections: int


@dataclass(frozen=True)
class LevelFacts:
    """What a coarser level of the mesh is, and how far it is from the points, in world units.

    ``rms`` is the root mean square distance of the points as they were given, ``error`` the largest both ways, after
    any denoising: what is told of the mesh itself.
    """

    vertices: int
    faces: int
    rms: float
    error: float


@dataclass(frozen=True)
class Distances:
    """Distances from the points to the mesh, in world units and in spacings of the points."""

    spacing: float
    mean: float
    rms: float
    percentile_95: float
    max: float

    @classmethod
    def of(cls, distances: NDArray[np.float64], spacing: float) -> Distances:
        """Sum up the distance of each point (n,), n > 0, both in world units."""
        largest = float(distances.max())
        # Squares of very large and very small lengths are no doubles.
        shares = distances / largest if largest > 0 else distances
        return cls(
            spacing=float(spacing),
            mean=largest * float(shares.mean()),
            rms=largest * float(np.sqrt(np.mean(shares**2))),
            percentile_95=float(np.percentile(distances, 95)),
            max=largest,
        )

    def as_dict(self) -> dict[str, Any]:
        """Return both units side by side, fit for JSON."""
        in_world = {name: value for name, value in asdict(self).items() if name != "spacing"}
        in_spacings = {name: value / self.spacing for name, value in in_world.items()} if self.spacing > 0 else None
        return {"spacing": self.spacing, "in_world_units": in_world, "in_spacings": in_spacings}


@dataclass(frozen=True)
class HeightDifferences:
    """How far the points are above or below the mesh, along z and in world units.

    ``points`` are as many as have the mesh above or below them, ``others`` as many as have not.
    """

    points: int
    others: int
    rms: float
    percentile_95: float
    max: float

    @classmethod
    def of(cls, differences: NDArray[np.float64]) -> HeightDifferences | None:
        """Sum up those (n,) that are known, of either sign; the others are NaN. None if none is."""
        known = abs(differences[np.isfinite(differences)])
        if not len(known):
            return None
        found = Distances.of(known, 0.0)
        return cls(len(known), len(differences) - len(known), found.rms, found.percentile_95, found.max)
